// How far surfaces are from where they should be, in pixels, by nearest distances at points that pictures
// show.
#pragma once

#include "lod/cut.hpp"
#include "measure/accuracy/surface_pixels.hpp"

#include <span>
#include <vector>

namespace triptych {

/// One point and how far it is off.
struct PointDeviation {
  double pixels = 0;
  DrawableId drawable = no_id;  ///< the one that is measured
  glm::dvec3 place{0};          ///< model space
  int x = 0, y = 0;             ///< the pixel that shows the place, from the lower left one
};

/// So many pixels (or all of them), spread over a picture of that many; the same ones each time.
std::vector<size_t> spread_pixels(size_t count, size_t of);

/// Of what a picture shows: the distance from each point to the source surfaces that its drawable stands for.
/// Pixels of the background, and those whose point is not known, have none.
std::vector<PointDeviation> shown_deviations(const PackSurfaces& surfaces, const FrameView& view,
                                             std::span<const SurfacePixel> shown,
                                             std::span<const size_t> pixels);

/// Back from the full detail: the distance from each point of the reference to the drawable of the cut that
/// stands for it, culled or not; infinite where none does. reference: pixels that show finest leaf drawables.
std::vector<PointDeviation> reference_deviations(const PackSurfaces& surfaces, const FrameView& view,
                                                 const Cut& cut, std::span<const SurfacePixel> reference,
                                                 std::span<const size_t> pixels);

}  // namespace triptych
