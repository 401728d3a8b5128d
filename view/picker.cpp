#include "view/picker.hpp"

#include "scene/hidden_objects.hpp"
#include "scene/ray.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

namespace triptych {

EyeRay eye_ray(const View& view, double x, double y) {
  const Camera& camera = view.camera;
  const glm::dmat3 axes = glm::transpose(view.rotation());  // right, up, backward
  const double right = camera.left + (camera.right - camera.left) * x / view.width;
  const double up = camera.top - (camera.top - camera.bottom) * y / view.height;
  const glm::dvec3 aside = right * axes[0] + up * axes[1];
  if (camera.orthographic()) return {camera.eye + aside, -axes[2], camera.near};
  return {camera.eye, aside - axes[2], camera.near};
}

glm::dvec3 Picker::place_at(const View& view, double x, double y, double depth) {
  const EyeRay ray = eye_ray(view, x, y);
  return ray.from + depth * ray.way;
}

std::optional<Picked> Picker::at(const FrameState& frame, std::span<const DrawableId> shown, double x,
                                 double y) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Skeleton& skeleton = pack_.skeleton();
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  const EyeRay ray = eye_ray(frame.view, x, y);
  const RaySpan span(ray.from, ray.way, ray.near, infinite);
  std::vector<std::pair<double, DrawableId>> met;  // in the order of their boxes
  for (const DrawableId drawable : shown) {
    const Box box = skeleton.lattice().box(skeleton.scene_nodes[skeleton.drawables[drawable].scene_node].box);
    const double from = span.entry(box);
    if (std::isfinite(from)) met.push_back({from, drawable});
  }
  std::sort(met.begin(), met.end());
  double nearest = infinite;
  std::optional<Picked> found;
  for (const auto& [from, drawable] : met) {
    if (from > nearest) break;
    const Drawable& placed = skeleton.drawables[drawable];
    for (uint32_t i = 0; i < placed.placement_count; ++i) {
      if (hidden && hidden->hides(placed.scene_node, i)) continue;
      const auto hit = meet({ray.from, ray.way, ray.near, nearest}, skeleton,
                            skeleton.placements[placed.first_placement + i], chunks_);
      if (!hit) continue;
      nearest = hit->along;
      found = Picked{drawable, i, hit->triangle, ray.from + nearest * ray.way};
    }
  }
  return found;
}

}  // namespace triptych
