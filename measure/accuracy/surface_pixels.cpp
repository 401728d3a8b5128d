#include "measure/accuracy/surface_pixels.hpp"

#include "base/threads.hpp"

#include <cmath>
#include <glm/matrix.hpp>
#include <limits>

namespace triptych {

namespace {

/// The rays of a view, in model space. `along` counts depth.
class PixelRays {
 public:
  explicit PixelRays(const FrameView& view) : view_(view.view()), axes_(glm::transpose(view.rotation)) {}

  struct Ray {
    glm::dvec3 origin, direction;
  };
  /// x, y: window coordinates, from the lower left corner.
  Ray at(double x, double y) const {
    const Camera& camera = view_.camera;
    const double across = camera.left + x / view_.focal_x(), up = camera.bottom + y / view_.focal_y();
    const glm::dvec3 aside = axes_[0] * across + axes_[1] * up;
    if (camera.orthographic()) return {camera.eye + aside, -axes_[2]};
    return {camera.eye, aside - axes_[2]};
  }

 private:
  const View& view_;
  glm::dmat3 axes_;  ///< right, up, backward
};

/// Where a ray through the centre just misses what a device drew there, one of these may not.
constexpr std::array<glm::dvec2, 5> offsets = {
    {{0, 0}, {1.0 / 128, 0}, {-1.0 / 128, 0}, {0, 1.0 / 128}, {0, -1.0 / 128}}};

SurfacePixel look(const PackSurfaces& surfaces, const FrameView& view, const PixelRays& rays, DrawableId id,
                  int x, int y) {
  SurfacePixel pixel{.drawable = id};
  for (const glm::dvec2& offset : offsets) {
    const PixelRays::Ray ray = rays.at(x + 0.5 + offset.x, y + 0.5 + offset.y);
    const auto hit = surfaces.first_hit(id, ray.origin, ray.direction, view.view().camera.near);
    if (!hit) continue;
    pixel.found = true;
    pixel.point = ray.origin + hit->along * ray.direction;
    pixel.color = surfaces.skeleton().palette[hit->color];
    break;
  }
  return pixel;
}

}  // namespace

std::vector<SurfacePixel> surface_pixels(const PackSurfaces& surfaces, const FrameView& view,
                                         std::span<const uint32_t> items) {
  const auto width = static_cast<size_t>(view.view().width);
  const PixelRays rays(view);
  std::vector<SurfacePixel> pixels(items.size());
  parallel_for(static_cast<size_t>(view.view().height), [&](size_t row) {
    for (size_t column = 0; column < width; ++column) {
      const size_t at = row * width + column;
      if (items[at] != 0)
        pixels[at] =
            look(surfaces, view, rays, items[at] - 1, static_cast<int>(column), static_cast<int>(row));
    }
  });
  return pixels;
}

double projected_distance(const FrameView& view, const glm::dvec3& point, double distance) {
  const double focal = view.view().focal_length();
  if (view.view().camera.orthographic()) return focal * distance;
  const glm::dvec3 eye = view.rotation * (point - view.view().camera.eye);
  if (!(eye.z < 0)) return std::numeric_limits<double>::infinity();
  const double x = eye.x / eye.z, y = eye.y / eye.z;
  return focal * distance * std::sqrt(1 + x * x + y * y) / -eye.z;
}

}  // namespace triptych
