// Cut selection: which drawables stand for the model in one view. Pure: a function of skeleton, view and
// pixel error.
#pragma once

#include "scene/camera.hpp"
#include "scene/skeleton.hpp"

#include <compare>
#include <cstdint>
#include <vector>

namespace triptych {

/// The order in which drawables are tested and drawn: squared distance from the eye's lattice cell to the
/// scene node's box, in integers, ties by id. Every machine agrees on it, and a child never ranks before its
/// parent.
struct DrawRank {
  uint64_t distance = 0;
  DrawableId id = 0;
  auto operator<=>(const DrawRank&) const = default;
};

/// The eye's cell on the model lattice, clamped to where differences still fit.
glm::ivec3 eye_cell(const Skeleton& skeleton, const View& view);
/// Squared distance from the cell to the box, in lattice steps; 0 inside it.
uint64_t squared_distance(const glm::ivec3& cell, const LatticeBox& box);
DrawRank draw_rank(const Skeleton& skeleton, const glm::ivec3& cell, DrawableId drawable);
/// Sorts drawables of one view by their draw rank.
void sort_by_rank(const Skeleton& skeleton, const glm::ivec3& cell, std::vector<DrawableId>& drawables);

/// The vertex stage works in 32-bit floats relative to the eye: what it draws is off by less than this share
/// of the distance. visibility/screen_bounds.cpp has the parts of it.
inline constexpr double vertex_rounding = 0x1p-17;

/// Where a box lies in eye space, as far as selection needs it.
struct EyeBounds {
  double least_depth = 0;  ///< of the box along the view axis; negative behind the eye
  bool outside = false;    ///< so far beyond one of the frustum's planes that no rounding draws any of it
  double stretch = 1;     ///< √(1 + |t|²), t the largest tangent from the view axis within box and frustum
  bool parallel = false;  ///< orthographic: the picture does not depend on depth
};

/// The pixel error of a surface that deviates by at most `error` (δ, model units): f·δ·√(1+|t|²)/(z−δ), and
/// infinite where z ≤ δ (vlod-2005 §4; derived in docs/algorithms.md). Orthographic: f·δ, f in pixels per
/// model unit.
double projected_error(double focal_length, double error, const EyeBounds& bounds);

/// What one view needs to place boxes: computed once a frame.
class EyeSpace {
 public:
  EyeSpace(const Skeleton& skeleton, const View& view);
  EyeBounds bounds(const LatticeBox& box) const;

 private:
  const Lattice& lattice_;
  glm::dvec3 eye_;
  glm::dmat3 rotation_;
  double left_, right_, bottom_, top_, near_, corner_stretch_, diagonal_;
  bool orthographic_;
};

/// Whether drawables outside the frustum belong to the selection: `on` gives the cut; `off` adds the rest of
/// the model at the detail that its distance asks for, which is what a program without any culling would
/// draw.
enum class FrustumCulling { on, off };

/// The drawables that cover the view frustum, each the coarsest that keeps the pixel error.
struct Cut {
  static constexpr DrawableId inner = no_id - 1;  ///< the scene node was refined: its children hold the cut

  std::vector<DrawableId> drawables;  ///< in draw rank order
  /// For each scene node: its drawable in the cut, `inner`, or no_id where the cut is above it or the frustum
  /// elsewhere.
  std::vector<DrawableId> choice;
};

/// pixel_error 0 selects full detail: every leaf's finest drawable.
Cut select_cut(const Skeleton& skeleton, const View& view, double pixel_error,
               FrustumCulling culling = FrustumCulling::on);

}  // namespace triptych
