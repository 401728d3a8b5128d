#include "visibility/pixel_sides.hpp"

#include "base/rounding.hpp"

#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Perspective: a point at depth z on the ray (tx, ty, −1) is h + z · (n · ray) from the side, h being the
/// eye's distance; divided by z, with depth d = near / z: n · ray + h / near · d. Orthographic, z is
/// near + (1 − d) · range.
[[gnu::noinline]] PixelSide pixel_side(const FrameView& view, const SectionPlane& side,
                                       const glm::dvec3& normal, const glm::dvec2& offset) {
  const View& of = view.view();
  const Camera& camera = of.camera;
  const double eye = side.distance(camera.eye);
  const double x = normal.x / of.focal_x(), y = normal.y / of.focal_y();
  double at = normal.x * camera.left + normal.y * camera.bottom + (x * offset.x + y * offset.y) +
              view.section_space.tolerance();
  if (!view.clip.orthographic) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(at - normal.z),
            static_cast<float>(eye / view.clip.near)};
  }
  const double range = view.clip.range;
  at += eye - normal.z * (view.clip.near + range);
  return {static_cast<float>(x / range), static_cast<float>(y / range), static_cast<float>(at / range),
          static_cast<float>(normal.z)};
}

}  // namespace

PixelSides::PixelSides(const FrameView& view, const SamplePlace& place) {
  const NearestRounding rounding;
  for (const SectionPlane& side : view.section_space.sides().all()) {
    const glm::dvec3 normal = view.rotation * side.normal;
    normals_[count_] = glm::vec3(normal);
    sides_[count_++] = pixel_side(view, side, normal, place.pixels());
  }
}

std::optional<PixelSides::Entry> PixelSides::entry(float px, float py) const {
  std::optional<Entry> last;
  for (uint32_t i = 0; i < count_; ++i) {
    const float along = sides_[i].along(px, py), of_depth = sides_[i].of_depth;
    if (!(along + of_depth < 0)) continue;
    const float depth = along / -of_depth;
    if (!last || depth < last->depth) last = Entry{i, depth};
  }
  return last;
}

}  // namespace triptych
