#include "view/picker.hpp"

#include "scene/affine.hpp"
#include "scene/hidden_objects.hpp"
#include "scene/ray.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

constexpr uint64_t most_kept_triangles = 500'000;
constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

Picker::Ray Picker::ray(const View& view, double x, double y) {
  const Camera& camera = view.camera;
  const glm::dmat3 axes = glm::transpose(view.rotation());  // right, up, backward
  const double right = camera.left + (camera.right - camera.left) * x / view.width;
  const double up = camera.top - (camera.top - camera.bottom) * y / view.height;
  const glm::dvec3 aside = right * axes[0] + up * axes[1];
  if (camera.orthographic()) return {camera.eye + aside, -axes[2], camera.near};
  return {camera.eye, aside - axes[2], camera.near};
}

glm::dvec3 Picker::place_at(const View& view, double x, double y, double depth) {
  const Ray ray = Picker::ray(view, x, y);
  return ray.from + depth * ray.way;
}

std::optional<Picked> Picker::at(const FrameState& frame, std::span<const DrawableId> shown, double x,
                                 double y) {
  const Skeleton& skeleton = pack_.skeleton();
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  const Ray ray = Picker::ray(frame.view, x, y);
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
    const uint32_t placements = skeleton.drawables[drawable].placement_count;
    const SceneNodeId node = skeleton.drawables[drawable].scene_node;
    for (uint32_t i = 0; i < placements; ++i) {
      if (hidden == nullptr || !hidden->hides(node, i)) meet(ray, drawable, i, nearest, found);
    }
  }
  return found;
}

void Picker::meet(const Ray& ray, DrawableId drawable, uint32_t placement, double& nearest,
                  std::optional<Picked>& found) {
  const Skeleton& skeleton = pack_.skeleton();
  const Placement& placed = skeleton.placements[skeleton.drawables[drawable].first_placement + placement];
  const Affine& transform = skeleton.transforms[placed.transform];
  const ChunkInfo& info = skeleton.chunks[placed.chunk];
  const Lattice& lattice = skeleton.lattices[info.lattice];
  const RaySpan span(ray.from, ray.way, ray.near, nearest);
  if (!span.meets(placed_box(transform, lattice.box(info.box)))) return;
  const glm::dmat3 linear(transform);
  if (glm::determinant(linear) == 0) return;  // it is flat, and has no area to be seen
  // On the chunk's own lattice, where lengths along the ray are the same.
  const glm::dmat3 inverse = glm::inverse(linear);
  const glm::dvec3 from = (inverse * (ray.from - transform[3]) - lattice.origin) / lattice.step;
  const glm::dvec3 way = inverse * ray.way / lattice.step;
  const Chunk& geometry = chunk(placed.chunk);
  for (uint32_t i = 0; i < geometry.triangle_count(); ++i) {
    const auto corner = [&](size_t k) {
      return glm::dvec3(geometry.vertices[geometry.indices[3 * i + k]].point);
    };
    const auto hit = meet_triangle(from, way, corner(0), corner(1), corner(2));
    if (!hit || hit->along < ray.near || hit->along >= nearest) continue;
    nearest = hit->along;
    found = Picked{drawable, placement, i, ray.from + hit->along * ray.way};
  }
}

const Chunk& Picker::chunk(uint32_t number) {
  const auto known = chunks_.find(number);
  if (known != chunks_.end()) return *known->second;
  if (kept_triangles_ > most_kept_triangles) {
    chunks_.clear();
    kept_triangles_ = 0;
  }
  auto read = std::make_shared<const Chunk>(pack_.read_chunk(number));
  kept_triangles_ += read->triangle_count();
  return *chunks_.emplace(number, std::move(read)).first->second;
}

}  // namespace triptych
