#include "view/near_cursor.hpp"

#include "scene/affine.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/ray.hpp"
#include "view/shown_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <utility>

namespace triptych {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Beyond that many times the depth of what is hit nothing is looked at: what lies deeper may be hidden.
constexpr double deepest_seen = 1.25;

double distance_to_segment(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 way = b - a;
  const double square = glm::dot(way, way);
  const double share = square > 0 ? std::clamp(glm::dot(point - a, way) / square, 0.0, 1.0) : 0;
  return glm::distance(point, a + share * way);
}

/// A triangle's part behind the near plane, as it is seen: up to four corners.
struct SeenPolygon {
  std::array<glm::dvec2, 4> corners;
  size_t count = 0;

  double distance(const glm::dvec2& point) const {
    double least = infinite;
    int left = 0, right = 0;
    for (size_t i = 0; i < count; ++i) {
      const glm::dvec2 a = corners[i], b = corners[(i + 1) % count];
      least = std::min(least, distance_to_segment(point, a, b));
      const double side = (b.x - a.x) * (point.y - a.y) - (b.y - a.y) * (point.x - a.x);
      (side < 0 ? left : right) += side != 0;
    }
    return count > 0 && (left == 0 || right == 0) && left + right > 0 ? 0 : least;
  }
};

SeenPolygon seen(const PictureSpace& space, const std::array<glm::dvec3, 3>& eye) {
  const double near = space.view().camera.near;
  SeenPolygon polygon;
  const auto add = [&](const glm::dvec3& corner) { polygon.corners[polygon.count++] = space.pixel(corner); };
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &a = eye[i], &b = eye[(i + 1) % 3];
    if (-a.z >= near) add(a);
    if ((-a.z >= near) != (-b.z >= near)) {
      glm::dvec3 cut = a + (b - a) * ((-near - a.z) / (b.z - a.z));
      cut.z = -near;
      add(cut);
    }
  }
  return polygon;
}

}  // namespace

PictureSpace::PictureSpace(const View& view) : view_(view), rotation_(view.rotation()) {}

glm::dvec2 PictureSpace::pixel(const glm::dvec3& from_eye) const {
  const Camera& camera = view_.camera;
  const double depth = camera.orthographic() ? 1 : -from_eye.z;
  return {(from_eye.x / depth - camera.left) * view_.focal_x(),
          (camera.top - from_eye.y / depth) * view_.focal_y()};
}

double PictureSpace::units_a_pixel(double depth) const {
  const double scale = 1 / std::min(view_.focal_x(), view_.focal_y());
  return view_.camera.orthographic() ? scale : scale * depth;
}

glm::dvec3 PictureSpace::sight() const { return -glm::transpose(rotation_)[2]; }

NearCursor::NearCursor(const Skeleton& skeleton, ChunkShelf& chunks, const FrameState& frame,
                       std::span<const DrawableId> shown, const glm::dvec2& cursor, double pixels)
    : skeleton_(skeleton),
      chunks_(chunks),
      section_(frame.section),
      hidden_(frame.hiding.objects),
      poses_(poses_of(skeleton, frame)),
      space_(frame.view),
      cursor_(cursor),
      pixels_(pixels),
      ray_(eye_ray(frame.view, cursor.x, cursor.y)),
      sight_(space_.sight()),
      hit_depth_(infinite) {
  hit_ = nearest(collect(shown, 0, infinite), ray_, infinite);
  if (hit_) hit_depth_ = glm::dot(hit_->point - frame.view.camera.eye, sight_);
  places_ = collect(shown, pixels, deepest_seen * hit_depth_);
  // Of thousands of things within a few pixels nobody means one.
  constexpr uint64_t most_triangles = 150'000;
  uint64_t triangles = 0;
  for (const Place& place : places_) triangles += skeleton_.chunks[placement_of(place).chunk].triangle_count;
  if (triangles > most_triangles) places_.clear();
}

double NearCursor::entry(const Box& box, double pixels, double deepest) const {
  const glm::dvec3 middle = center(box), half = box.hi - middle;
  const double depth = glm::dot(middle - space_.view().camera.eye, sight_) + glm::dot(half, glm::abs(sight_));
  if (depth < ray_.near) return infinite;
  // A point at some depth that is seen within the pixels lies so near to the ray's point at that depth.
  const glm::dvec3 margin(pixels * space_.units_a_pixel(depth));
  return RaySpan(ray_.from, ray_.way, ray_.near, deepest).entry({box.lo - margin, box.hi + margin});
}

std::vector<NearCursor::Place> NearCursor::collect(std::span<const DrawableId> shown, double pixels,
                                                   double deepest) const {
  const ShownNodes nodes(skeleton_, shown);
  std::vector<Place> places;
  std::vector<std::pair<SceneNodeId, bool>> open;  // and whether it is, or is below, one that shows something
  if (!skeleton_.scene_nodes.empty()) open.emplace_back(0, false);
  while (!open.empty()) {
    auto [at, is_shown] = open.back();
    open.pop_back();
    const SceneNode& node = skeleton_.scene_nodes[at];
    if (!std::isfinite(entry(skeleton_.lattice().box(node.box), pixels, deepest))) continue;
    is_shown = is_shown || nodes.of(at) != no_id;
    for (uint32_t i = 0; i < node.child_count; ++i) open.emplace_back(node.first_child + i, is_shown);
    if (node.child_count > 0 || !is_shown) continue;
    const Drawable& finest = skeleton_.drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) {
      if (hidden_ && hidden_->hides(at, i)) continue;
      const Placement& placement = skeleton_.placements[finest.first_placement + i];
      const ChunkInfo& info = skeleton_.chunks[placement.chunk];
      const double from = entry(placed_box(placed_transform(skeleton_, poses_.get(), placement),
                                           skeleton_.lattices[info.lattice].box(info.box)),
                                pixels, deepest);
      if (std::isfinite(from)) places.push_back({from, node.first_drawable, i});
    }
  }
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.entry < b.entry; });
  return places;
}

const Placement& NearCursor::placement_of(const Place& place) const {
  return skeleton_.placements[skeleton_.drawables[place.drawable].first_placement + place.placement];
}

std::optional<Picked> NearCursor::nearest(std::span<const Place> places, const EyeRay& eye,
                                          double most) const {
  PlacedRay ray = kept_part(eye.from, eye.way, eye.near, section_);
  ray.most = std::min(ray.most, most);
  std::optional<Picked> found;
  for (const Place& place : places) {
    if (place.entry > ray.most) break;
    const auto hit = meet(ray, skeleton_, placement_of(place),
                          placed_transform(skeleton_, poses_.get(), placement_of(place)), chunks_);
    if (!hit) continue;
    ray.most = hit->along;
    found =
        Picked{place.drawable, place.placement, hit->triangle, ray.from + hit->along * ray.way, hit->normal};
  }
  return found;
}

std::vector<NearFacet> NearCursor::facets(size_t most) const {
  std::vector<NearFacet> found;
  for (const Place& place : places_) {
    if (place.entry > hit_depth_) break;
    add_facets(place, found);
    if (found.size() > most) return {};
  }
  return found;
}

void NearCursor::add_facets(const Place& place, std::vector<NearFacet>& facets) const {
  const Placement& placement = placement_of(place);
  const std::shared_ptr<const Chunk> chunk = chunks_.get(placement.chunk);
  const Affine transform = placed_transform(skeleton_, poses_.get(), placement);
  std::vector<glm::dvec3> corners, eye;
  std::vector<glm::dvec2> pixels;
  for (uint32_t i = 0; i < chunk->vertices.size(); ++i) {
    corners.push_back(placed_position(skeleton_, placement, transform, *chunk, i));
    eye.push_back(space_.from_eye(corners.back()));
    pixels.push_back(space_.pixel(eye.back()));
  }
  const double near = space_.view().camera.near;
  for (uint32_t i = 0; i < chunk->triangle_count(); ++i) {
    const std::array<uint32_t, 3> at = {chunk->indices[size_t{3} * i], chunk->indices[size_t{3} * i + 1],
                                        chunk->indices[size_t{3} * i + 2]};
    const auto behind = std::count_if(at.begin(), at.end(), [&](uint32_t k) { return -eye[k].z < near; });
    if (behind == 3) continue;
    if (behind == 0) {  // most lie elsewhere, and are seen to at once
      const glm::dvec2 lo = glm::min(glm::min(pixels[at[0]], pixels[at[1]]), pixels[at[2]]);
      const glm::dvec2 hi = glm::max(glm::max(pixels[at[0]], pixels[at[1]]), pixels[at[2]]);
      if (lo.x > cursor_.x + pixels_ || hi.x < cursor_.x - pixels_ || lo.y > cursor_.y + pixels_ ||
          hi.y < cursor_.y - pixels_)
        continue;
    }
    if (seen(space_, {eye[at[0]], eye[at[1]], eye[at[2]]}).distance(cursor_) > pixels_) continue;
    facets.push_back({{corners[at[0]], corners[at[1]], corners[at[2]]}, place.drawable, place.placement, i});
  }
}

bool NearCursor::sees(const glm::dvec3& point) const {
  const double depth = glm::dot(point - space_.view().camera.eye, space_.sight());
  if (depth < ray_.near || depth > deepest_seen * hit_depth_) return false;
  const double nearly_none = skeleton_.lattice().step;
  for (const SectionPlane& side : section_.all()) {
    if (side.distance(point) < -nearly_none) return false;
  }
  EyeRay ray{ray_.from, ray_.way, ray_.near};
  if (space_.view().camera.orthographic()) {
    ray.from = point - depth * ray.way;
  } else {
    ray.way = (point - ray.from) / depth;
  }
  // What meets in the point, and may be rounded to before it, does not hide it.
  return !nearest(places_, ray, depth * (1 - 1e-7) - 4 * nearly_none);
}

}  // namespace triptych
