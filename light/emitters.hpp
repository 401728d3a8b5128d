// What gives light in a model, and how much of it comes to a point.
#pragma once

#include "light/area_sources.hpp"
#include "light/light_options.hpp"
#include "light/lit_scene.hpp"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace triptych {

struct Emitters {
  std::vector<ModelLight> lights;
  AreaSources surfaces;                ///< that emit
  std::vector<glm::dvec3> luminaires;  ///< for each instance the radiance of all of its surfaces, or 0
  uint64_t luminaire_count = 0;

  bool any() const { return !lights.empty() || !surfaces.empty(); }
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

}  // namespace triptych
