#include "measure/pixel_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace triptych {

namespace {
constexpr std::array<glm::dvec2, 5> offsets = {
    {{0, 0}, {1.0 / 128, 0}, {-1.0 / 128, 0}, {0, 1.0 / 128}, {0, -1.0 / 128}}};
}  // namespace

PixelRays::PixelRays(const FrameView& view)
    : frame_(view), view_(view.view()), axes_(glm::transpose(view.rotation)) {}

double PixelRays::begin(const glm::dvec3& origin, const glm::dvec3& direction) const {
  const SectionSpace& section = frame_.section_space;
  const bool parallel = view_.camera.orthographic();
  double from = view_.camera.near;
  for (const SectionPlane& side : section.sides().all()) {
    // Devices keep what is beyond a side by no more than the tolerance, of the depth or of lengths.
    const double tolerance = 2 * section.tolerance();
    const double at = side.distance(origin) + (parallel ? tolerance : 0),
                 slope = glm::dot(side.normal, direction) + (parallel ? 0 : tolerance);
    if (at < 0) from = slope > 0 ? std::max(from, -at / slope) : std::numeric_limits<double>::infinity();
  }
  return from;
}

std::optional<PixelRays::Hit> PixelRays::hit(const PackSurfaces& surfaces, DrawableId drawable, int x,
                                             int y) const {
  const Camera& camera = view_.camera;
  for (const glm::dvec2& offset : offsets) {
    const glm::dvec3 aside = axes_[0] * (camera.left + (x + 0.5 + offset.x) / view_.focal_x()) +
                             axes_[1] * (camera.bottom + (y + 0.5 + offset.y) / view_.focal_y());
    // The direction is of depth 1, so that hits count depth.
    const glm::dvec3 origin = camera.orthographic() ? camera.eye + aside : camera.eye;
    const glm::dvec3 direction = camera.orthographic() ? -axes_[2] : aside - axes_[2];
    const double from = begin(origin, direction);
    if (!std::isfinite(from)) continue;
    if (const auto surface =
            surfaces.first_hit(drawable, origin, direction, from, frame_.state.hiding.objects.get()))
      return Hit{origin + surface->along * direction, *surface};
  }
  return std::nullopt;
}

}  // namespace triptych
