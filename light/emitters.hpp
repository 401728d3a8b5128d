// What gives light in a model, and how much of it comes to a point.
#pragma once

#include "light/light_options.hpp"
#include "light/lit_scene.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace triptych {

/// Emissive triangles of one placement.
struct EmissiveBody {
  std::vector<uint32_t> triangles;  ///< of the scene that they are sampled from
  std::vector<double> areas;        ///< up to and with each of them
  glm::dvec3 middle{0};
  double radius = 0;
  double power = 0;  ///< luminance times area
  double area() const { return areas.back(); }
};

struct Emitters {
  std::vector<ModelLight> lights;
  std::vector<EmissiveBody> bodies;
  std::vector<uint32_t> body_of;       ///< for each instance its body; no_id
  std::vector<glm::dvec3> luminaires;  ///< for each instance the radiance of all of its surfaces, or 0
  uint64_t emissive_triangles = 0, luminaire_count = 0;

  bool any() const { return !lights.empty() || !bodies.empty(); }
  /// Of a triangle, to either side, cd/m².
  glm::dvec3 radiance(const LitScene& scene, uint32_t triangle) const {
    const glm::dvec3& own = luminaires[scene.model().triangles[triangle].instance];
    return own == glm::dvec3(0) ? scene.surface(triangle).radiance : own;
  }
};

/// Whether IFC calls things of this type luminaires.
bool is_luminaire_type(std::string_view type);

/// The emitters of a model, sampled from this scene, which is of its triangles.
Emitters find_emitters(const Model& model, const LitScene& scene);

/// Relative luminance of linear colours (IEC 61966-2-1).
inline double luminance(const glm::dvec3& color) {
  return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

}  // namespace triptych
