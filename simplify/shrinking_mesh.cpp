#include "simplify/shrinking_mesh.hpp"

#include "simplify/color_charts.hpp"

#include <algorithm>

namespace triptych {

ShrinkingMesh::ShrinkingMesh(const Surface& surface)
    : points_(surface.points), colors_(surface.colors), slots_(surface.points.size()) {
  alive_ = surface.triangles.size();
  faces_.reserve(alive_);
  for (const Triangle& triangle : surface.triangles) {
    faces_.push_back({triangle.vertices, triangle.material, 0});
    for (const uint32_t corner : triangle.vertices) ++slots_[corner].capacity;
  }
  if (has_colors()) {
    ColorCharts charts = color_charts(surface);
    for (size_t i = 0; i < faces_.size(); ++i) faces_[i].material = charts.of_triangles[i];
    chart_materials_ = std::move(charts.materials);
  }
  uint32_t next = 0;
  for (Slot& slot : slots_) {
    slot.first = next;
    next += slot.capacity;
  }
  places_.resize(next);
  for (uint32_t i = 0; i < faces_.size(); ++i) {
    for (const uint32_t corner : faces_[i].corners) {
      Slot& slot = slots_[corner];
      places_[slot.first + slot.count++] = i;
      ++slot.alive;
    }
  }
  packed_size_ = places_.size();
}

std::span<const uint32_t> ShrinkingMesh::star(uint32_t point) {
  Slot& slot = slots_[point];
  uint32_t* const places = places_.data() + slot.first;
  if (slot.count > slot.alive) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < slot.count; ++i) {
      if (faces_[places[i]].corners[0] != gone) places[kept++] = places[i];
    }
    slot.count = kept;
  }
  return {places, slot.count};
}

void ShrinkingMesh::star(uint32_t point, std::vector<Spoke>& spokes) {
  const auto own = star(point);
  spokes.resize(own.size());
  for (size_t i = 0; i < own.size(); ++i) {
    const Face& face = faces_[own[i]];
    const size_t at = face.corners[0] == point ? 0 : face.corners[1] == point ? 1 : 2;
    spokes[i] = {own[i], face.corners[at == 2 ? 0 : at + 1], face.corners[at == 0 ? 2 : at - 1],
                 face.material, face.error};
  }
}

bool ShrinkingMesh::is_textured_across(uint32_t triangle, uint32_t other, uint32_t point,
                                       uint32_t end) const {
  const auto at = [&](uint32_t face, uint32_t corner) {
    const auto& corners = faces_[face].corners;
    return colors_[face][corners[0] == corner ? 0 : corners[1] == corner ? 1 : 2].coordinates;
  };
  return at(triangle, point) == at(other, point) && at(triangle, end) == at(other, end);
}

void ShrinkingMesh::set_color(uint32_t triangle, uint32_t point, const SurfaceCorner& color) {
  const auto& corners = faces_[triangle].corners;
  colors_[triangle][corners[0] == point ? 0 : corners[1] == point ? 1 : 2] = color;
}

void ShrinkingMesh::remove(uint32_t triangle) {
  for (const uint32_t corner : faces_[triangle].corners) --slots_[corner].alive;
  faces_[triangle].corners[0] = gone;
  --alive_;
}

void ShrinkingMesh::move(std::span<const uint32_t> triangles, uint32_t from, uint32_t to) {
  for (const uint32_t triangle : triangles) {
    auto& corners = faces_[triangle].corners;
    *std::find(corners.begin(), corners.end(), from) = to;
  }
  make_room(to, static_cast<uint32_t>(triangles.size()), slots_[from]);
  Slot& slot = slots_[to];
  std::copy(triangles.begin(), triangles.end(), places_.begin() + slot.first + slot.count);
  slot.count += static_cast<uint32_t>(triangles.size());
  slot.alive += static_cast<uint32_t>(triangles.size());
  slots_[from].count = slots_[from].alive = 0;
  if (places_.size() > 2 * packed_size_ + 64) pack();
}

/// Makes space for `added` more triangles in the star of the point: in the space of the star that is left
/// behind if that is large enough, otherwise at the end.
void ShrinkingMesh::make_room(uint32_t point, uint32_t added, Slot& left) {
  Slot& slot = slots_[point];
  if (slot.count + added <= slot.capacity) return;
  const auto own = star(point);
  if (slot.count + added <= slot.capacity) return;
  const bool into_left = slot.count + added <= left.capacity;
  // With some reserve, so that a hub that grows by a few at a time is not copied each time.
  const uint32_t capacity = into_left ? left.capacity : slot.count + std::max(added, slot.count / 4);
  const auto first = into_left ? left.first : static_cast<uint32_t>(places_.size());
  const auto before = slot.first;
  if (!into_left) places_.resize(places_.size() + capacity);
  std::copy_n(places_.begin() + before, own.size(), places_.begin() + first);
  slot.first = first;
  slot.capacity = capacity;
  if (into_left) left.capacity = 0;
}

void ShrinkingMesh::pack() {
  std::vector<uint32_t> packed;
  packed.reserve(3 * alive_);
  for (uint32_t i = 0; i < slots_.size(); ++i) {
    const auto own = star(i);
    const auto size = static_cast<uint32_t>(own.size());
    slots_[i] = {static_cast<uint32_t>(packed.size()), size, size, size};
    packed.insert(packed.end(), own.begin(), own.end());
  }
  places_ = std::move(packed);
  packed_size_ = places_.size();
}

Piece ShrinkingMesh::piece() const {
  Piece piece;
  piece.surface.triangles.reserve(alive_);
  std::vector<uint32_t> places(points_.size(), gone);
  for (size_t i = 0; i < faces_.size(); ++i) {
    const Face& face = faces_[i];
    if (face.corners[0] == gone) continue;
    Triangle& triangle = piece.surface.triangles.emplace_back(Triangle{face.corners, face.material});
    if (has_colors()) {
      triangle.material = chart_materials_[face.material];
      piece.surface.colors.push_back(colors_[i]);
    }
    for (uint32_t& corner : triangle.vertices) {
      if (places[corner] == gone) {
        places[corner] = static_cast<uint32_t>(piece.sources.size());
        piece.sources.push_back(corner);
        piece.surface.points.push_back(points_[corner]);
      }
      corner = places[corner];
    }
  }
  return piece;
}

std::vector<double> ShrinkingMesh::errors() const {
  std::vector<double> errors;
  errors.reserve(alive_);
  for (const Face& face : faces_) {
    if (face.corners[0] != gone) errors.push_back(face.error);
  }
  return errors;
}

}  // namespace triptych
