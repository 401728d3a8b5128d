#include "visibility/screen_bounds.hpp"

#include "base/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>

namespace triptych {

namespace {
/// The vertex stage works in 32-bit floats relative to the eye. A position is off by at most 11 · 2⁻²⁴ of its
/// distance under the identity, by 83 · 2⁻²⁴ under the worst matrix that a build shares a mesh under
/// (lod/plan.cpp), which is 2.6 times this.
constexpr double float_rounding = 0x1p-19;
/// Beyond this tangent, rounding in w may reach the margin of depths.
constexpr double max_narrow_tangent = 8;
/// Boxes whose nearest corner is within this factor of the near plane count as touching it.
constexpr double near_margin = 1.001;

/// Whether the rectangle's depth is the nearest possible, at its middle and its corners.
bool says_nothing(const ScreenRectangle& r) {
  return r.depth((r.left + r.right) / 2, (r.bottom + r.top) / 2) >= 1 && r.depth(r.left, r.bottom) >= 1 &&
         r.depth(r.right, r.bottom) >= 1 && r.depth(r.left, r.top) >= 1 && r.depth(r.right, r.top) >= 1;
}
}  // namespace

BoxProjector::BoxProjector(const FrameView& view, const DeviceMargins& margins)
    : lattice_(&view.skeleton->lattice()),
      margins_(margins),
      rules_(view.rules),
      view_(view.view()),
      clip_(view.clip),
      rotation_(view.rotation),
      focal_length_(view.focal_length),
      faces_(view, margins) {}

ScreenBounds BoxProjector::bounds(const LatticeBox& box, const ExtentTester* tester) const {
  const NearestRounding rounding;
  const Box model_box = lattice_->box(box);  // exact
  const Extent found = extent(model_box);
  if (found.beyond) return {.kind = ScreenBounds::Kind::off_screen, .rectangle = {}};
  const ScreenExtent sides{.left = static_cast<float>(found.left),
                           .bottom = static_cast<float>(found.bottom),
                           .right = static_cast<float>(found.right),
                           .top = static_cast<float>(found.top),
                           .nearest = static_cast<float>(found.nearest)};
  // What may be as near as can be is shown without a test, whatever is there.
  if (tester != nullptr && sides.nearest < 1 && tester->hides(sides))
    return {.kind = ScreenBounds::Kind::hidden, .rectangle = {}};
  ScreenRectangle rectangle{.left = sides.left,
                            .bottom = sides.bottom,
                            .right = sides.right,
                            .top = sides.top,
                            .planes = {},
                            .cuts = silhouette(std::span(found.corners).first(found.count), found.margin)};
  rectangle.planes[0].middle = sides.nearest;
  const auto faces = faces_.of(model_box, rules_.bounds_margin ? 2 : 0);
  std::copy(faces.begin(), faces.end(), rectangle.planes.begin() + 1);
  if (says_nothing(rectangle)) return {};
  return {.kind = ScreenBounds::Kind::rectangle, .rectangle = rectangle};
}

bool BoxProjector::is_off_screen(const LatticeBox& box) const {
  const NearestRounding rounding;
  return extent(lattice_->box(box)).beyond;
}

DepthBound BoxProjector::depth_bound(const LatticeBox& box) const {
  const NearestRounding rounding;
  const Box model_box = lattice_->box(box);
  const Extent found = extent(model_box);
  return {.nearest = static_cast<float>(found.nearest), .planes = faces_.of(model_box, 1)};
}

PixelDepthBound BoxProjector::pixel_bound(const LatticeBox& box) const {
  const DepthBound bound = rules_.fragment_bound ? depth_bound(box) : DepthBound{};
  return triptych::pixel_bound(bound, view_.width, view_.height);
}

BoxProjector::Extent BoxProjector::extent(const Box& box) const {
  return clip_.orthographic ? parallel_extent(box) : perspective_extent(box);
}

[[gnu::noinline]] BoxProjector::Extent BoxProjector::perspective_extent(const Box& model_box) const {
  double min_depth = 1e300, max_depth = -1e300, max_tangent = 0, furthest = 0;
  Extent seen;
  for (int i = 0; i < 8; ++i) {
    glm::dvec3 relative = model_box.corner(i) - clip_.reference;
    if (!rules_.double_bounds) relative = glm::vec3(model_box.corner(i)) - glm::vec3(clip_.reference);
    const glm::dvec3 corner = rotation_ * relative;
    const double depth = -corner.z;
    furthest = std::max(furthest, glm::length(corner));
    min_depth = std::min(min_depth, depth);
    max_depth = std::max(max_depth, depth);
    if (depth <= 0) continue;
    seen.corners[seen.count++] = glm::dvec2(corner) / depth;
    max_tangent = std::max(max_tangent, glm::length(corner) / depth);
  }
  if (max_depth + furthest * vertex_rounding < clip_.near / near_margin) return {.beyond = true};
  if (min_depth < clip_.near * near_margin) {
    if (rules_.near_plane_refines) return {};
    min_depth = max_depth;
  }
  // Rounding of the projected position, in pixels: the relative error of the vertex stage times |p|/w, twice
  // (p and w).
  const double rounding = 2 * float_rounding * max_tangent * max_tangent * focal_length_;
  if (!(rounding <= 0.25 || max_tangent <= max_narrow_tangent)) return {};
  const double margin = rules_.bounds_margin ? 1 + share_of_depth : 1;
  return on_screen(seen, clip_.depth(min_depth) * margin, rounding);
}

[[gnu::noinline]] BoxProjector::Extent BoxProjector::parallel_extent(const Box& box) const {
  const glm::dvec3 centre = rotation_ * ((box.lo + box.hi) * 0.5 - clip_.reference);
  const glm::dvec3 half = (box.hi - box.lo) * 0.5;
  // Rows of the rotation are the eye's axes.
  glm::dvec3 reach;
  for (int row = 0; row < 3; ++row) {
    reach[row] = std::abs(rotation_[0][row]) * half.x + std::abs(rotation_[1][row]) * half.y +
                 std::abs(rotation_[2][row]) * half.z;
  }
  const double depth = clip_.reference_depth - centre.z;
  // Rounding of positions is relative to how far they are from the reference.
  const double rounding = float_rounding * (glm::length(centre) + glm::length(half));
  const double touch = share_of_depth * clip_.range + rounding;
  if (depth + reach.z < clip_.near - touch) return {.beyond = true};
  if (depth - reach.z < clip_.near + touch) return {};
  const double margin = rules_.bounds_margin ? touch / clip_.range : 0;
  Extent seen;
  for (int i = 0; i < 8; ++i)
    seen.corners[seen.count++] = glm::dvec2(rotation_ * (box.corner(i) - clip_.reference));
  return on_screen(seen, clip_.depth(depth - reach.z) + margin, 2 * rounding * focal_length_);
}

BoxProjector::Extent BoxProjector::on_screen(Extent seen, double depth, double rounding) const {
  const Camera& camera = view_.camera;
  const double pixels = rules_.bounds_margin ? std::max(margins_.outline, margins_.roundings * rounding) : 0;
  if (!std::isfinite(pixels)) return {};
  seen.margin = {2 * pixels / view_.width, 2 * pixels / view_.height};
  const glm::dvec2 low(camera.left, camera.bottom), high(camera.right, camera.top);
  glm::dvec2 lo(1e300), hi(-1e300);
  for (glm::dvec2& corner : std::span(seen.corners).first(seen.count)) {
    corner = 2.0 * (corner - low) / (high - low) - 1.0;
    lo = glm::min(lo, corner - seen.margin);
    hi = glm::max(hi, corner + seen.margin);
  }
  if (lo.x > 1 || hi.x < -1 || lo.y > 1 || hi.y < -1) return {.beyond = true};
  seen.left = std::max(lo.x, -1.0);
  seen.bottom = std::max(lo.y, -1.0);
  seen.right = std::min(hi.x, 1.0);
  seen.top = std::min(hi.y, 1.0);
  seen.nearest = std::min(1.0, depth);
  return seen;
}

}  // namespace triptych
