#include "lod/simplify/shrinking_mesh.hpp"

#include <algorithm>

namespace triptych {

ShrinkingMesh::ShrinkingMesh(const Surface& surface)
    : points_(surface.points), slots_(surface.points.size()) {
  alive_ = surface.triangles.size();
  faces_.reserve(alive_);
  for (const Triangle& triangle : surface.triangles) {
    faces_.push_back({triangle.vertices, triangle.material, 0});
    for (const uint32_t corner : triangle.vertices) ++slots_[corner].capacity;
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
    }
  }
  packed_size_ = places_.size();
}

std::span<const uint32_t> ShrinkingMesh::star(uint32_t point) {
  Slot& slot = slots_[point];
  uint32_t* const places = places_.data() + slot.first;
  uint32_t kept = 0;
  for (uint32_t i = 0; i < slot.count; ++i) {
    if (faces_[places[i]].corners[0] != gone) places[kept++] = places[i];
  }
  slot.count = kept;
  return {places, kept};
}

void ShrinkingMesh::star(uint32_t point, std::vector<Spoke>& spokes) {
  Slot& slot = slots_[point];
  uint32_t* const places = places_.data() + slot.first;
  uint32_t kept = 0;
  spokes.resize(slot.count);
  for (uint32_t i = 0; i < slot.count; ++i) {
    const Face& face = faces_[places[i]];
    if (face.corners[0] == gone) continue;
    const size_t own = face.corners[0] == point ? 0 : face.corners[1] == point ? 1 : 2;
    spokes[kept] = {places[i], face.corners[own == 2 ? 0 : own + 1], face.corners[own == 0 ? 2 : own - 1],
                    face.material, face.error};
    places[kept++] = places[i];
  }
  slot.count = kept;
  spokes.resize(kept);
}

void ShrinkingMesh::remove(uint32_t triangle) {
  faces_[triangle].corners[0] = gone;
  --alive_;
}

void ShrinkingMesh::move(std::span<const uint32_t> triangles, uint32_t from, uint32_t to) {
  for (const uint32_t triangle : triangles) {
    auto& corners = faces_[triangle].corners;
    *std::find(corners.begin(), corners.end(), from) = to;
  }
  const auto added = static_cast<uint32_t>(triangles.size());
  const auto own = star(to);
  Slot &slot = slots_[to], &left = slots_[from];
  if (slot.count + added > slot.capacity) {
    // The star that is left behind may have the room; otherwise the end has.
    const bool into_left = slot.count + added <= left.capacity;
    const uint32_t count = slot.count;
    const auto first = into_left ? left.first : static_cast<uint32_t>(places_.size());
    const uint32_t capacity = into_left ? left.capacity : count + added;
    const auto before = slot.first;
    if (!into_left) places_.resize(places_.size() + capacity);
    std::copy_n(places_.begin() + before, own.size(), places_.begin() + first);
    slot = {first, count, capacity};
    if (into_left) left.capacity = 0;
  }
  std::copy(triangles.begin(), triangles.end(), places_.begin() + slot.first + slot.count);
  slot.count += added;
  left.count = 0;
  if (places_.size() > 2 * packed_size_ + 64) pack();
}

void ShrinkingMesh::pack() {
  std::vector<uint32_t> packed;
  packed.reserve(3 * alive_);
  for (uint32_t i = 0; i < slots_.size(); ++i) {
    const auto own = star(i);
    slots_[i] = {static_cast<uint32_t>(packed.size()), static_cast<uint32_t>(own.size()),
                 static_cast<uint32_t>(own.size())};
    packed.insert(packed.end(), own.begin(), own.end());
  }
  places_ = std::move(packed);
  packed_size_ = places_.size();
}

Piece ShrinkingMesh::piece() const {
  Piece piece;
  piece.surface.triangles.reserve(alive_);
  std::vector<uint32_t> places(points_.size(), gone);
  for (const Face& face : faces_) {
    if (face.corners[0] == gone) continue;
    Triangle& triangle = piece.surface.triangles.emplace_back(Triangle{face.corners, face.material});
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

}  // namespace triptych
