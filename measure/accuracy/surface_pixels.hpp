// What the pixels of a picture show: points of surfaces, found by rays, so that of a device only the ids of
// drawables are believed.
#pragma once

#include "lod/frame_view.hpp"
#include "preprocess/check/check_surfaces.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

struct SurfacePixel {
  DrawableId drawable = no_id;  ///< no_id: background
  bool found = false;   ///< whether the ray through the pixel meets the drawable; if not, no more is known
  glm::dvec3 point{0};  ///< model space
  std::array<uint8_t, 4> color{};  ///< base colour, sRGB

  bool background() const { return drawable == no_id; }
};

/// One for each pixel. items: of the view's size, as FrameTarget::read_items() gives them. On all cores.
std::vector<SurfacePixel> surface_pixels(const PackSurfaces& surfaces, const FrameView& view,
                                         std::span<const uint32_t> items);

/// By how many pixels what is at `point` (model space) moves on the screen, at most, where it moves by
/// `distance` in any direction: to first order f·d·√(1+|t|²)/z, orthographic f·d. This is no part of the
/// selection of levels, which it judges. Infinite for a point that is not before the eye.
double projected_distance(const FrameView& view, const glm::dvec3& point, double distance);

}  // namespace triptych
