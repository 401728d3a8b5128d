// About how many pixels boxes cover.
#pragma once

#include "lod/frame_view.hpp"

#include <array>
#include <glm/vec3.hpp>

namespace triptych {

/// The rectangle around a box's corners on the screen, within the picture. An estimate, not a bound: a corner
/// behind the near plane counts as on it, in its own direction.
class CoveredPixels {
 public:
  /// Of boxes on this lattice, which must outlive it.
  explicit CoveredPixels(const Lattice& lattice) : lattice_(lattice) {}
  void begin(const FrameView& view);
  double by(const LatticeBox& box) const;

 private:
  const Lattice& lattice_;
  glm::dvec3 eye_{0};
  std::array<glm::dvec3, 3> axes_{};  ///< the model's, in eye axes
  double left_ = -1, right_ = 1, bottom_ = -1, top_ = 1, near_ = 0, pixels_a_square_ = 1;
  bool parallel_ = false;
};

}  // namespace triptych
