// What is at a pixel by a ray, in double: of a device only the drawable is believed.
#pragma once

#include "lod/frame_view.hpp"
#include "preprocess/check/check_surfaces.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace triptych {

/// The rays of one view, which must outlive it.
class PixelRays {
 public:
  explicit PixelRays(const FrameView& view);

  struct Hit {
    glm::dvec3 point{0};  ///< model space
    PackSurfaces::Hit surface{};
  };
  /// The nearest triangle that is not hidden of the drawable, behind the near plane and where the ray comes
  /// into the section (at a cut surface that is what lies behind it), at the middle of the pixel in column x
  /// and row y, counted from the lower left, or up to 1/128 of a pixel beside it: a ray just misses what a
  /// device drew at an outline. Nullopt where all of those miss.
  std::optional<Hit> hit(const PackSurfaces& surfaces, DrawableId drawable, int x, int y) const;

 private:
  /// Where a ray may meet something first; infinite where the section keeps nothing of it.
  double begin(const glm::dvec3& origin, const glm::dvec3& direction) const;

  const FrameView& frame_;
  const View& view_;
  glm::dmat3 axes_;  ///< right, up, backward
};

}  // namespace triptych
