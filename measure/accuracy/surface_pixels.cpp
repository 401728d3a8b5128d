#include "measure/accuracy/surface_pixels.hpp"

#include "base/threads.hpp"
#include "measure/pixel_rays.hpp"

#include <cmath>
#include <limits>

namespace triptych {

namespace {

SurfacePixel look(const PackSurfaces& surfaces, const PixelRays& rays, DrawableId id, int x, int y) {
  SurfacePixel pixel{.drawable = id};
  const auto hit = rays.hit(surfaces, id, x, y);
  pixel.found = hit.has_value();
  if (!hit) return pixel;
  pixel.point = hit->point;
  pixel.color = surfaces.skeleton().palette[hit->surface.color];
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
        pixels[at] = look(surfaces, rays, items[at] - 1, static_cast<int>(column), static_cast<int>(row));
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
