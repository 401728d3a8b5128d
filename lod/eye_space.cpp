#include "lod/eye_space.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace triptych {

namespace {
/// Orthographic, positions and depths are relative to a point near the model's middle, and rounded by less
/// than this share of the model's size and of how far the box is from the view axis.
constexpr double rounding_of_size = 0x1p-14;
}  // namespace

double projected_error(double focal_length, double error, const EyeBounds& bounds) {
  if (bounds.parallel) return focal_length * error;
  if (!(bounds.min_depth > error)) return std::numeric_limits<double>::infinity();
  return focal_length * error * bounds.stretch / (bounds.min_depth - error);
}

EyeSpace::EyeSpace(const Skeleton& skeleton, const View& view, const glm::dmat3& rotation,
                   const FrameRules& rules)
    : lattice_(&skeleton.lattice()),
      eye_(view.camera.eye),
      rotation_(rotation),
      left_(view.camera.left),
      right_(view.camera.right),
      bottom_(view.camera.bottom),
      top_(view.camera.top),
      near_(view.camera.near),
      corner_stretch_(view.corner_stretch()),
      diagonal_(skeleton.diagonal()),
      orthographic_(view.camera.orthographic()),
      rules_(rules),
      axes_{direction({1, 0, 0}), direction({0, 1, 0}), direction({0, 0, 1})},
      // Inside the frustum: x − left·depth ≥ 0, right·depth − x ≥ 0, and so on; depth = −z.
      sides_{direction({1, 0, left_}), direction({-1, 0, -right_}), direction({0, 1, bottom_}),
             direction({0, -1, -top_})} {}

/// A box's reach along a direction d of eye space is Σ |(rotationᵀ d)_k| half_k.
EyeSpace::Direction EyeSpace::direction(const glm::dvec3& eye) const {
  return {eye, glm::abs(glm::transpose(rotation_) * eye), glm::length(eye)};
}

double EyeSpace::rounding(const glm::dvec3& centre, const glm::dvec3& half) const {
  if (orthographic_) return rounding_of_size * (diagonal_ + glm::length(glm::dvec2(centre)));
  return vertex_rounding * (glm::length(centre) + glm::length(half));
}

double EyeSpace::rounding(const Box& box) const {
  return rounding(rotation_ * ((box.lo + box.hi) * 0.5 - eye_), (box.hi - box.lo) * 0.5);
}

bool EyeSpace::is_beyond_near(const LatticeBox& box) const {
  const Box model_box = lattice_->box(box);
  const glm::dvec3 centre = rotation_ * ((model_box.lo + model_box.hi) * 0.5 - eye_);
  const glm::dvec3 half = (model_box.hi - model_box.lo) * 0.5;
  return -centre.z - glm::dot(axes_[2].absolute, half) - 2 * rounding(centre, half) > near_;
}

EyeBounds EyeSpace::bounds(const LatticeBox& box) const {
  const Box model_box = lattice_->box(box);
  const glm::dvec3 centre = rotation_ * ((model_box.lo + model_box.hi) * 0.5 - eye_);
  const glm::dvec3 half = (model_box.hi - model_box.lo) * 0.5;
  const auto reach = [&](const Direction& along) { return glm::dot(along.absolute, half); };
  const double depth = -centre.z, depth_reach = reach(axes_[2]);
  EyeBounds bounds{.min_depth = depth - depth_reach};
  const double margin = rules_.frustum_margin ? rounding(centre, half) : 0;
  if (orthographic_) {
    // Inside the frustum: left ≤ x ≤ right, bottom ≤ y ≤ top.
    const double x = reach(axes_[0]) + margin, y = reach(axes_[1]) + margin;
    bounds.outside = depth + depth_reach + margin < near_ || centre.x + x < left_ || centre.x - x > right_ ||
                     centre.y + y < bottom_ || centre.y - y > top_;
    bounds.parallel = rules_.orthographic_error;
    return bounds;
  }
  // Pixel centres are inside the picture, so snapping does not matter.
  const auto beyond = [&](const Direction& side) {
    return glm::dot(side.eye, centre) + reach(side) + side.length * margin < 0;
  };
  bounds.outside = depth + depth_reach + margin < near_ || std::any_of(sides_.begin(), sides_.end(), beyond);
  bounds.stretch = corner_stretch_;
  if (!rules_.min_depth_error && bounds.min_depth > 0)
    bounds.min_depth = glm::length(centre) - glm::length(half);
  if (bounds.min_depth > 0) {
    const double x = std::abs(centre.x) + reach(axes_[0]), y = std::abs(centre.y) + reach(axes_[1]);
    const double tangent_squared = (x * x + y * y) / (bounds.min_depth * bounds.min_depth);
    bounds.stretch = std::min(bounds.stretch, std::sqrt(1 + tangent_squared));
  }
  if (!rules_.oblique_stretch) bounds.stretch = 1;
  return bounds;
}

}  // namespace triptych
