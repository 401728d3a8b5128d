#include "view/picker.hpp"

#include "scene/affine.hpp"
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

/// Faces that lie in a side are there, as on the screen.
void Picker::cut(Ray& ray, const Section& section) {
  constexpr double in_a_side = 1e-6;  // of the distance
  for (const SectionPlane& side : SectionSides(section).all()) {
    const double from = side.distance(ray.from), slope = glm::dot(side.normal, ray.way);
    const double along = -from / slope;
    if (slope > 0 && along > ray.near) {
      ray.near = along * (1 - in_a_side);
      ray.entered = side;
    } else if (slope < 0) {
      ray.far = std::min(ray.far, along * (1 + in_a_side));
    } else if (slope == 0 && from < 0) {
      ray.far = -infinite;
    }
  }
}

std::optional<Picked> Picker::at(const View& view, std::span<const DrawableId> shown, double x, double y,
                                 const Section& section) {
  const Skeleton& skeleton = pack_.skeleton();
  Ray ray = Picker::ray(view, x, y);
  cut(ray, section);
  const RaySpan span(ray.from, ray.way, ray.near, ray.far);
  std::vector<std::pair<double, DrawableId>> met;  // in the order of their boxes
  for (const DrawableId drawable : shown) {
    const Box box = skeleton.lattice().box(skeleton.scene_nodes[skeleton.drawables[drawable].scene_node].box);
    const double from = span.entry(box);
    if (std::isfinite(from)) met.push_back({from, drawable});
  }
  std::sort(met.begin(), met.end());
  double nearest = ray.far;
  std::optional<Picked> found;
  for (const auto& [from, drawable] : met) {
    if (from > nearest) break;
    const uint32_t placements = skeleton.drawables[drawable].placement_count;
    for (uint32_t i = 0; i < placements; ++i) meet(ray, drawable, i, nearest, found);
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
  const std::vector<bool> outward = ray.entered ? geometry.outward() : std::vector<bool>();
  // Backs less fronts of what is solid, from where the ray comes in; and the nearest of the backs.
  int winding = 0;
  std::pair<double, uint32_t> back{infinite, 0};
  for (uint32_t i = 0; i < geometry.triangle_count(); ++i) {
    const auto corner = [&](size_t k) {
      return glm::dvec3(geometry.vertices[geometry.indices[3 * i + k]].point);
    };
    const auto hit = meet_triangle(from, way, corner(0), corner(1), corner(2));
    if (!hit || hit->along < ray.near) continue;
    if (ray.entered && outward[i]) {
      const bool is_back = glm::dot(glm::cross(corner(1) - corner(0), corner(2) - corner(0)), way) > 0;
      winding += is_back ? 1 : -1;
      if (is_back) back = std::min(back, {hit->along, i});
    }
    if (hit->along >= nearest) continue;
    nearest = hit->along;
    const glm::dvec3 across = glm::cross(linear * (corner(1) - corner(0)), linear * (corner(2) - corner(0)));
    const glm::dvec3 normal = glm::normalize(glm::dot(across, ray.way) > 0 ? -across : across);
    found = Picked{drawable, placement, i, ray.from + hit->along * ray.way, normal};
  }
  if (winding <= 0) return;
  nearest = ray.near;
  found = Picked{drawable, placement, back.second, ray.from + nearest * ray.way, -ray.entered->normal};
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
