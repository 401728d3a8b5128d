#include "measure/pixel_rays.hpp"

#include <array>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

namespace triptych {

namespace {
constexpr std::array<glm::dvec2, 5> offsets = {
    {{0, 0}, {1.0 / 128, 0}, {-1.0 / 128, 0}, {0, 1.0 / 128}, {0, -1.0 / 128}}};
}  // namespace

PixelRays::PixelRays(const FrameView& view) : view_(view.view()), axes_(glm::transpose(view.rotation)) {}

std::optional<PixelRays::Hit> PixelRays::hit(const PackSurfaces& surfaces, DrawableId drawable, int x,
                                             int y) const {
  const Camera& camera = view_.camera;
  for (const glm::dvec2& offset : offsets) {
    const glm::dvec3 aside = axes_[0] * (camera.left + (x + 0.5 + offset.x) / view_.focal_x()) +
                             axes_[1] * (camera.bottom + (y + 0.5 + offset.y) / view_.focal_y());
    // The direction is of depth 1, so that hits count depth.
    const glm::dvec3 origin = camera.orthographic() ? camera.eye + aside : camera.eye;
    const glm::dvec3 direction = camera.orthographic() ? -axes_[2] : aside - axes_[2];
    if (const auto surface = surfaces.first_hit(drawable, origin, direction, camera.near))
      return Hit{origin + surface->along * direction, *surface};
  }
  return std::nullopt;
}

}  // namespace triptych
