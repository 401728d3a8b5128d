#include "lod/cut.hpp"

#include "base/inject.hpp"
#include "base/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace triptych {

glm::ivec3 eye_cell(const Skeleton& skeleton, const View& view) {
  const Lattice& lattice = skeleton.lattice();
  const glm::dvec3 cell =
      glm::floor(round_to_nearest([&] { return (view.camera.eye - lattice.origin) / lattice.step; }));
  return glm::ivec3(glm::clamp(cell, glm::dvec3(-Lattice::limit), glm::dvec3(Lattice::limit)));
}

uint64_t squared_distance(const glm::ivec3& cell, const LatticeBox& box) {
  // Each difference is below 2^31, its square below 2^62, the sum below 2^64.
  uint64_t sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const int64_t below = int64_t{box.lo[axis]} - cell[axis], above = int64_t{cell[axis]} - box.hi[axis];
    const auto outside = static_cast<uint64_t>(std::max({below, above, int64_t{0}}));
    sum += outside * outside;
  }
  return sum;
}

DrawRank draw_rank(const Skeleton& skeleton, const glm::ivec3& cell, DrawableId drawable) {
  const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[drawable].scene_node];
  return {squared_distance(cell, node.box), drawable};
}

void sort_by_rank(const Skeleton& skeleton, const glm::ivec3& cell, std::vector<DrawableId>& drawables) {
  std::vector<DrawRank> ranks;
  ranks.reserve(drawables.size());
  for (const DrawableId id : drawables) ranks.push_back(draw_rank(skeleton, cell, id));
  std::sort(ranks.begin(), ranks.end());
  std::transform(ranks.begin(), ranks.end(), drawables.begin(), [](const DrawRank& rank) { return rank.id; });
}

double projected_error(double focal_length, double error, const EyeBounds& bounds) {
  if (bounds.parallel && !injected(Fault::perspective_rule)) return focal_length * error;
  if (!(bounds.least_depth > error)) return std::numeric_limits<double>::infinity();
  return focal_length * error * bounds.stretch / (bounds.least_depth - error);
}

namespace {
/// Orthographic, positions and depths are relative to a point near the model's middle, and rounded by less
/// than this share of the model's size and of how far the box is from the view axis.
constexpr double rounding_of_size = 0x1p-14;
}  // namespace

EyeSpace::EyeSpace(const Skeleton& skeleton, const View& view)
    : lattice_(skeleton.lattice()),
      eye_(view.camera.eye),
      rotation_(view.rotation()),
      left_(view.camera.left),
      right_(view.camera.right),
      bottom_(view.camera.bottom),
      top_(view.camera.top),
      near_(view.camera.near),
      corner_stretch_(view.corner_stretch()),
      diagonal_(skeleton.diagonal()),
      orthographic_(view.camera.orthographic()) {}

EyeBounds EyeSpace::bounds(const LatticeBox& box) const {
  const Box model_box = lattice_.box(box);
  const glm::dvec3 centre = rotation_ * ((model_box.lo + model_box.hi) * 0.5 - eye_);
  const glm::dvec3 half = (model_box.hi - model_box.lo) * 0.5;
  // The box's reach along an eye-space direction d is Σ |(rotationᵀ d)_k| half_k.
  const auto reach = [&](const glm::dvec3& direction) {
    const glm::dvec3 turned = glm::abs(glm::transpose(rotation_) * direction);
    return glm::dot(turned, half);
  };
  const double depth = -centre.z, depth_reach = reach({0, 0, 1});
  EyeBounds bounds{.least_depth = depth - depth_reach};
  const double share = injected(Fault::exact_frustum) ? 0 : 1;
  if (orthographic_) {
    // Inside the frustum: left ≤ x ≤ right, bottom ≤ y ≤ top.
    const double margin = share * rounding_of_size * (diagonal_ + glm::length(glm::dvec2(centre)));
    const double x = reach({1, 0, 0}) + margin, y = reach({0, 1, 0}) + margin;
    bounds.outside = depth + depth_reach + margin < near_ || centre.x + x < left_ || centre.x - x > right_ ||
                     centre.y + y < bottom_ || centre.y - y > top_;
    bounds.parallel = true;
    return bounds;
  }
  // Inside the frustum: x − left·depth ≥ 0, right·depth − x ≥ 0, and so on; depth = −z. Pixel centres are
  // inside the picture, so snapping does not matter.
  const double margin = share * vertex_rounding * (glm::length(centre) + glm::length(half));
  const auto beyond = [&](const glm::dvec3& plane) {
    return glm::dot(plane, centre) + reach(plane) + glm::length(plane) * margin < 0;
  };
  bounds.outside = depth + depth_reach + margin < near_ || beyond({1, 0, left_}) ||
                   beyond({-1, 0, -right_}) || beyond({0, 1, bottom_}) || beyond({0, -1, -top_});
  bounds.stretch = corner_stretch_;
  if (injected(Fault::euclidean_depth) && bounds.least_depth > 0)
    bounds.least_depth = glm::length(centre) - glm::length(half);
  if (bounds.least_depth > 0) {
    const double x = std::abs(centre.x) + reach({1, 0, 0}), y = std::abs(centre.y) + reach({0, 1, 0});
    const double tangent_squared = (x * x + y * y) / (bounds.least_depth * bounds.least_depth);
    bounds.stretch = std::min(bounds.stretch, std::sqrt(1 + tangent_squared));
  }
  if (injected(Fault::dropped_stretch)) bounds.stretch = 1;
  return bounds;
}

namespace {

/// The coarsest drawable of the node that keeps the pixel error, or no_id.
DrawableId coarsest(const Skeleton& skeleton, const SceneNode& node, double focal_length, double pixel_error,
                    const EyeBounds& bounds) {
  for (uint32_t level = node.drawable_count; level-- > 0;) {
    const DrawableId id = node.first_drawable + level;
    if (projected_error(focal_length, skeleton.drawables[id].error, bounds) <= pixel_error) return id;
  }
  return no_id;
}

[[gnu::noinline]] Cut select(const Skeleton& skeleton, const View& view, double pixel_error,
                             FrustumCulling culling) {
  const EyeSpace eye_space(skeleton, view);
  const glm::ivec3 cell = eye_cell(skeleton, view);
  const double focal_length = view.focal_length();
  Cut cut;
  cut.choice.assign(skeleton.scene_nodes.size(), no_id);
  std::vector<SceneNodeId> open = {0};
  while (!open.empty()) {
    const SceneNodeId id = open.back();
    open.pop_back();
    const SceneNode& node = skeleton.scene_nodes[id];
    EyeBounds bounds = eye_space.bounds(node.box);
    if (bounds.outside) {
      if (culling == FrustumCulling::on) continue;
      bounds.least_depth =
          std::sqrt(static_cast<double>(squared_distance(cell, node.box))) * skeleton.lattice().step;
      bounds.stretch = 1;
    }
    DrawableId chosen = pixel_error > 0 ? coarsest(skeleton, node, focal_length, pixel_error, bounds) : no_id;
    if (chosen == no_id && node.child_count == 0) chosen = node.first_drawable;
    if (chosen != no_id) {
      cut.choice[id] = chosen;
      cut.drawables.push_back(chosen);
      continue;
    }
    cut.choice[id] = Cut::inner;
    for (uint32_t child = 0; child < node.child_count; ++child) open.push_back(node.first_child + child);
  }
  sort_by_rank(skeleton, cell, cut.drawables);
  return cut;
}

}  // namespace

Cut select_cut(const Skeleton& skeleton, const View& view, double pixel_error, FrustumCulling culling) {
  return round_to_nearest([&] { return select(skeleton, view, pixel_error, culling); });
}

}  // namespace triptych
