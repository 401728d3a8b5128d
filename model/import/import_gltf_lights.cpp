// The lights of a glTF scene (KHR_lights_punctual).
#include "model/import/import_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

std::optional<ModelLight::Kind> kind_of(const std::string& type) {
  if (type == "point") return ModelLight::Kind::point;
  if (type == "spot") return ModelLight::Kind::spot;
  if (type == "directional") return ModelLight::Kind::directional;
  return std::nullopt;
}

/// In the space of its node.
std::optional<ModelLight> read_light(const GltfLight& source) {
  const auto kind = kind_of(source.type);
  if (!kind) return std::nullopt;
  ModelLight light;
  light.kind = *kind;
  for (int k = 0; k < 3; ++k) {
    light.intensity[k] = source.color[static_cast<size_t>(k)] * source.intensity;
    if (!std::isfinite(light.intensity[k]) || light.intensity[k] < 0) return std::nullopt;
  }
  if (std::isfinite(source.range) && source.range > 0) light.range = source.range;
  light.inner_cosine = std::cos(source.inner_angle);
  light.outer_cosine = std::cos(source.outer_angle);
  if (!(light.inner_cosine > light.outer_cosine)) light.inner_cosine = light.outer_cosine;
  return light;
}

}  // namespace

void add_gltf_lights(const GltfDocument& gltf, const std::vector<size_t>& roots, FileImport& target) {
  if (gltf.lights.empty()) return;
  struct Open {
    size_t node;
    Affine transform;
  };
  std::vector<Open> open;
  for (size_t i = roots.size(); i-- > 0;) open.push_back({roots[i], Affine(1)});
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    const GltfNode& node = gltf.nodes[next.node];
    if (!node.visible) continue;
    const Affine transform =
        next.transform * glm::dmat4(gltf_local_transform(node, target.place() + ": node"));
    if (node.light >= 0) {
      const bool known = static_cast<size_t>(node.light) < gltf.lights.size();
      auto light = known ? read_light(gltf.lights[static_cast<size_t>(node.light)]) : std::nullopt;
      const glm::dvec3 ahead = glm::dmat3(transform) * glm::dvec3(0, 0, -1);
      const double length = glm::length(ahead);
      if (light && length > 0 && std::isfinite(length) && std::isfinite(glm::length(transform[3]))) {
        light->position = transform[3];
        light->direction = ahead / length;
        target.add_light(*light);
      } else {
        target.warn("lights are of no known type, or not where numbers are finite, and give no light");
      }
    }
    for (size_t i = node.children.size(); i-- > 0;)
      open.push_back({static_cast<size_t>(node.children[i]), transform});
  }
}

}  // namespace triptych
