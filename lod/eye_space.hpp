// Where boxes lie in one view's eye space, as far as the selection of levels needs it.
#pragma once

#include "lod/frame_rules.hpp"
#include "scene/camera.hpp"
#include "scene/skeleton.hpp"

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace triptych {

/// The vertex stage works in 32-bit floats relative to the eye: what it draws is off by less than this share
/// of the distance. visibility/screen_bounds.cpp says what it is made of.
inline constexpr double vertex_rounding = 0x1p-17;

struct EyeBounds {
  double min_depth = 0;   ///< of the box along the view axis; negative behind the eye
  bool outside = false;   ///< beyond one of the frustum's planes, by more than rounding can bring back
  double stretch = 1;     ///< √(1 + |t|²), t the largest tangent from the view axis within box and frustum
  bool parallel = false;  ///< orthographic: the picture does not depend on depth
};

/// The pixel error of a surface that deviates by at most `error` (δ, model units): f·δ·√(1+|t|²)/(z−δ), and
/// infinite where z ≤ δ (vlod-2005 §4; derived in docs/algorithms.md). Orthographic: f·δ, f in pixels per
/// model unit.
double projected_error(double focal_length, double error, const EyeBounds& bounds);

/// What one view needs to place boxes: computed once a frame. The skeleton must outlive it.
class EyeSpace {
 public:
  /// rotation: view.rotation().
  EyeSpace(const Skeleton& skeleton, const View& view, const glm::dmat3& rotation, const FrameRules& rules);
  EyeBounds bounds(const LatticeBox& box) const;
  /// Whether all of the box is beyond the near plane, by more than rounding can bring it back: then the eye
  /// is outside of it, and nothing in it is cut.
  bool is_beyond_near(const LatticeBox& box) const;
  /// By how much what is drawn of the box may be elsewhere, model units.
  double rounding(const Box& box) const;

 private:
  /// A direction of eye space and, in model axes, its absolute value: a box's reach along it is a dot
  /// product.
  struct Direction {
    glm::dvec3 eye{0}, absolute{0};
    double length = 0;
  };
  Direction direction(const glm::dvec3& eye) const;
  /// By how much what is drawn of a box may be elsewhere.
  double rounding(const glm::dvec3& centre, const glm::dvec3& half) const;

  const Lattice* lattice_;
  glm::dvec3 eye_;
  glm::dmat3 rotation_;
  double left_, right_, bottom_, top_, near_, corner_stretch_, diagonal_;
  bool orthographic_;
  FrameRules rules_;
  std::array<Direction, 3> axes_;   ///< right, up, backward
  std::array<Direction, 4> sides_;  ///< inward normals of the frustum's sides
};

}  // namespace triptych
