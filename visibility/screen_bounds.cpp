#include "visibility/screen_bounds.hpp"

#include "base/rounding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

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

/// Two doubles: one instruction on every processor.
using Pair [[gnu::vector_size(16)]] = double;
Pair pair_of(double both) { return Pair{both, both}; }
Pair lesser(Pair a, Pair b) { return b < a ? b : a; }
Pair greater(Pair a, Pair b) { return a < b ? b : a; }
double least(Pair a) { return std::min(a[0], a[1]); }
double most(Pair a) { return std::max(a[0], a[1]); }

/// The corners of a box in eye axes, relative to the reference: sums of what each axis contributes, so that
/// eight corners take 18 products. Corner i is that of the high sides whose bits are in it: pairs differ
/// along the first axis.
struct EyeCorners {
  EyeCorners(const Box& box, const glm::dvec3& reference, const glm::dmat3& rotation, bool in_doubles) {
    low = in_doubles ? box.lo - reference : glm::dvec3(glm::vec3(box.lo) - glm::vec3(reference));
    high = in_doubles ? box.hi - reference : glm::dvec3(glm::vec3(box.hi) - glm::vec3(reference));
    const auto sums = [&](int row, std::array<Pair, 4>& result) {
      const auto along = [&](int axis) {
        return Pair{rotation[axis][row] * low[axis], rotation[axis][row] * high[axis]};
      };
      const Pair first = along(0), next = along(1), last = along(2);
      for (int i = 0; i < 4; ++i)
        result[static_cast<size_t>(i)] = first + pair_of(next[i & 1]) + pair_of(last[i >> 1]);
    };
    sums(0, x);
    sums(1, y);
    sums(2, z);
  }

  /// The distance to the corner that is furthest away.
  double furthest() const { return glm::length(glm::max(glm::abs(low), glm::abs(high))); }
  glm::dvec3 operator[](size_t i) const { return {x[i / 2][i % 2], y[i / 2][i % 2], z[i / 2][i % 2]}; }

  glm::dvec3 low, high;  ///< in model axes
  std::array<Pair, 4> x, y, z;
};

/// Whether the rectangle's depth is the nearest possible, at its middle and its corners.
bool says_nothing(const ScreenRectangle& r) {
  return r.depth((r.left + r.right) / 2, (r.bottom + r.top) / 2) >= 1 && r.depth(r.left, r.bottom) >= 1 &&
         r.depth(r.right, r.bottom) >= 1 && r.depth(r.left, r.top) >= 1 && r.depth(r.right, r.top) >= 1;
}
}  // namespace

BoxProjector::BoxProjector(const FrameView& view, const DeviceMargins& margins)
    : skeleton_(view.skeleton),
      poses_(view.poses),
      lattice_(&view.skeleton->lattice()),
      margins_(margins),
      rules_(view.rules),
      view_(view.view()),
      clip_(view.clip),
      rotation_(view.rotation),
      focal_length_(view.focal_length),
      faces_(view, margins) {
  const NearestRounding rounding;
  call_apart([&] {
    const Camera& camera = view_.camera;
    const glm::dvec2 low(camera.left, camera.bottom), high(camera.right, camera.top);
    screen_scale_ = 2.0 / (high - low);
    screen_shift_ = -(low + high) / (high - low);
  });
}

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
                            .cuts = outline(found)};
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
  const EyeCorners corners(model_box, clip_.reference, rotation_, rules_.double_bounds);
  const Pair nearest = greater(greater(corners.z[0], corners.z[1]), greater(corners.z[2], corners.z[3])),
             farthest = lesser(lesser(corners.z[0], corners.z[1]), lesser(corners.z[2], corners.z[3]));
  double min_depth = -most(nearest), max_depth = -least(farthest), max_tangent_squared = 0;
  glm::dvec2 lo(1e300), hi(-1e300);
  Extent seen;
  const double furthest = corners.furthest();
  if (max_depth + furthest * vertex_rounding < clip_.near / near_margin) return {.beyond = true};
  seen.has_outline = min_depth >= clip_.near * near_margin;
  if (!seen.has_outline) {
    if (rules_.near_plane_refines) return {};
    min_depth = max_depth;
  }
  if (seen.has_outline) {
    Pair low_x = pair_of(1e300), low_y = low_x, high_x = -low_x, high_y = -low_x, tangents = pair_of(0);
    for (size_t i = 0; i < 4; ++i) {
      const Pair per_depth = 1 / -corners.z[i], x = corners.x[i] * per_depth, y = corners.y[i] * per_depth;
      seen.corners[2 * i] = {x[0], y[0]};
      seen.corners[2 * i + 1] = {x[1], y[1]};
      low_x = lesser(low_x, x);
      low_y = lesser(low_y, y);
      high_x = greater(high_x, x);
      high_y = greater(high_y, y);
      tangents = greater(tangents, x * x + y * y + 1);
    }
    lo = {least(low_x), least(low_y)};
    hi = {most(high_x), most(high_y)};
    max_tangent_squared = most(tangents);
  } else {
    for (size_t i = 0; i < 8; ++i) {
      const double depth = -corners[i].z;
      if (depth <= 0) continue;
      const glm::dvec2 corner = glm::dvec2(corners[i]) * (1 / depth);
      seen.corners[i] = corner;
      lo = glm::min(lo, corner);
      hi = glm::max(hi, corner);
      max_tangent_squared = std::max(max_tangent_squared, corner.x * corner.x + corner.y * corner.y + 1);
    }
  }
  // Rounding of the projected position, in pixels: the relative error of the vertex stage times |p|/w, twice
  // (p and w).
  const double rounding = 2 * float_rounding * max_tangent_squared * focal_length_;
  if (!(rounding <= 0.25 || max_tangent_squared <= max_narrow_tangent * max_narrow_tangent)) return {};
  for (int axis = 0; axis < 3; ++axis) {
    seen.facing[static_cast<size_t>(axis)] = {corners.low[axis] > 0, corners.high[axis] < 0};
  }
  const double margin = rules_.bounds_margin ? 1 + share_of_depth : 1;
  put_on_screen(seen, lo, hi, clip_.depth(min_depth) * margin, rounding);
  return seen;
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
  const EyeCorners corners(box, clip_.reference, rotation_, true);
  glm::dvec2 lo(1e300), hi(-1e300);
  for (size_t i = 0; i < 8; ++i) {
    seen.corners[i] = glm::dvec2(corners[i]);
    lo = glm::min(lo, seen.corners[i]);
    hi = glm::max(hi, seen.corners[i]);
  }
  seen.has_outline = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double backward = rotation_[axis].z;
    seen.facing[static_cast<size_t>(axis)] = {backward<0, backward> 0};
  }
  put_on_screen(seen, lo, hi, clip_.depth(depth - reach.z) + margin, 2 * rounding * focal_length_);
  return seen;
}

std::array<HalfPlane, 4> BoxProjector::outline(const Extent& extent) const {
  if (!extent.has_outline) return {};
  std::array<glm::dvec2, 8> corners;
  for (size_t i = 0; i < 8; ++i) corners[i] = on_screen(extent.corners[i]);
  // Off axis, corners on the screen are less than what they were summed from.
  const double terms = 1 + std::abs(screen_shift_.x) + std::abs(screen_shift_.y);
  return silhouette(corners, extent.facing, extent.margin, terms);
}

void BoxProjector::put_on_screen(Extent& extent, const glm::dvec2& lo, const glm::dvec2& hi, double depth,
                                 double rounding) const {
  const double pixels = rules_.bounds_margin ? std::max(margins_.outline, margins_.roundings * rounding) : 0;
  if (!std::isfinite(pixels)) {
    extent = {};
    return;
  }
  extent.margin = {2 * pixels / view_.width, 2 * pixels / view_.height};
  const glm::dvec2 low = on_screen(lo) - extent.margin, high = on_screen(hi) + extent.margin;
  extent.beyond = low.x > 1 || high.x < -1 || low.y > 1 || high.y < -1;
  if (extent.beyond) return;
  extent.left = std::max(low.x, -1.0);
  extent.bottom = std::max(low.y, -1.0);
  extent.right = std::min(high.x, 1.0);
  extent.top = std::min(high.y, 1.0);
  extent.nearest = std::min(1.0, depth);
}

}  // namespace triptych
