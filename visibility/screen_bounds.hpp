// Where a box may appear on the screen: the rectangle and the nearest depth that the occlusion test uses.
#pragma once

#include "lod/frame_view.hpp"
#include "visibility/depth_bound.hpp"
#include "visibility/silhouette.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace triptych {

/// A rectangle in normalised device coordinates (−1 to 1, y up), cut at its corners, and over it a depth,
/// reversed: 1 at the near plane, 0 at infinity. No fragment of the box's content lies outside. Every pass
/// drops fragments that DepthBound does not allow, so no drawn fragment is nearer than `depth` there:
/// wherever the content is the nearest thing, a non-strict test of the rectangle passes. That is what makes
/// culling exact (docs/algorithms.md has the argument).
struct ScreenRectangle {
  float left = -1, bottom = -1, right = 1, top = 1;
  /// The least of these, clamped to 1; where it is below 0, the box does not reach. The first plane is
  /// constant: the depth of the nearest corner.
  std::array<DepthPlane, 4> planes;
  std::array<HalfPlane, 4> cuts;  ///< of its corners; the box does not reach beyond any of them
  float depth(float x, float y) const {
    return std::min({planes[0].at(x, y), planes[1].at(x, y), planes[2].at(x, y), planes[3].at(x, y)});
  }
  /// Whether the box may reach this point of the screen.
  bool covers(float x, float y) const {
    return x >= left && x <= right && y >= bottom && y <= top && depth(x, y) >= 0 &&
           std::all_of(cuts.begin(), cuts.end(), [&](const HalfPlane& cut) { return cut.at(x, y) >= 0; });
  }
};

/// The sides of a rectangle, and its first plane.
struct ScreenExtent {
  float left = -1, bottom = -1, right = 1, top = 1;
  float nearest = 1;
};

/// Knows of some extents that everything within them is hidden.
class ExtentTester {
 public:
  virtual ~ExtentTester() = default;
  /// Whether all that is within the sides, and as far as `nearest` or farther, is certainly hidden.
  virtual bool hides(const ScreenExtent& extent) const = 0;
};

struct ScreenBounds {
  enum class Kind : uint8_t {
    off_screen,  ///< covers no pixel centre
    hidden,      ///< certainly, as an ExtentTester knew
    unbounded,   ///< may be right before the eye, at every pixel: visible without a test
    rectangle,   ///< the rectangle holds
  };
  Kind kind = Kind::unbounded;
  ScreenRectangle rectangle;
};

/// Projects boxes of the model lattice under one frame view, whose skeleton must outlive it. Derived margins:
/// the rectangle grows on each side by what the device's rules ask for (DeviceMargins), and by more where
/// views are so narrow that rounding in the vertex stage is beyond that; the depth moves towards the eye by
/// 2⁻¹⁴ of itself, orthographic of its range (float rounding of w and z). Boxes that touch the near plane, or
/// that are extremely oblique, may be anywhere on the screen; their faces still bound their depth.
class BoxProjector {
 public:
  explicit BoxProjector(const FrameView& view, const DeviceMargins& margins = {});
  /// What the occlusion test draws. tester: asked before the rectangle is made, which takes longer.
  ScreenBounds bounds(const LatticeBox& box, const ExtentTester* tester = nullptr) const;
  /// Whether the box covers no pixel centre.
  bool is_off_screen(const LatticeBox& box) const;
  /// What fragments of the box's content are held to.
  DepthBound depth_bound(const LatticeBox& box) const;
  /// The same over pixels; no bound where FrameRules::fragment_bound is off.
  PixelDepthBound pixel_bound(const LatticeBox& box) const;
  /// The view's.
  LatticeBox box(SceneNodeId node) const {
    const LatticeBox& always = skeleton_->scene_nodes[node].box;
    return poses_ && poses_->moves(node) ? poses_->box(*lattice_, node, always) : always;
  }
  const Poses* poses() const { return poses_.get(); }

 private:
  /// Where the corners are: the rectangle, and one depth for all of it.
  struct Extent {
    bool beyond = false;  ///< off the screen
    double left = -1, bottom = -1, right = 1, top = 1;
    double nearest = 1;
    std::array<glm::dvec2, 8> corners{};  ///< as tangents; orthographic: in model units
    FacingSides facing{};
    bool has_outline = false;  ///< whether corners and sides are known
    glm::dvec2 margin{0};      ///< by how much content may be drawn beyond them
  };
  Extent extent(const Box& box) const;
  Extent perspective_extent(const Box& box) const;
  Extent parallel_extent(const Box& box) const;
  /// Completes an extent with these corners of its rectangle, as of a box's.
  void put_on_screen(Extent& extent, const glm::dvec2& lo, const glm::dvec2& hi, double depth,
                     double rounding) const;
  /// To normalised device coordinates.
  glm::dvec2 on_screen(const glm::dvec2& corner) const { return corner * screen_scale_ + screen_shift_; }
  std::array<HalfPlane, 4> outline(const Extent& extent) const;

  const Skeleton* skeleton_;
  std::shared_ptr<const Poses> poses_;
  const Lattice* lattice_;
  DeviceMargins margins_;
  FrameRules rules_;
  View view_;
  ClipSpace clip_;
  glm::dmat3 rotation_;
  double focal_length_;
  glm::dvec2 screen_scale_, screen_shift_;
  FacePlanes faces_;
};

}  // namespace triptych
