// Light baked into the vertices of a model: a step from model to model, before levels are made.
#pragma once

#include "light/gather.hpp"
#include "light/light_options.hpp"
#include "light/run_points.hpp"
#include "model/model.hpp"

namespace triptych {

/// The model, flattened, with a mesh of its own for each placement, triangles refined where light changes,
/// and Mesh::light. Diffuse light: direct, and options.bounces gatherings of what other surfaces reflect,
/// each from the irradiance at points that the one before has left. A point has the light of its brighter
/// side. reflectances: for each material the mean of its texture, linear; white where it has none. Where
/// there is nothing to compute (no emitter, and no ambient occlusion asked for) the model comes back as it
/// was, and the report's `baked` and `ambient` are false. Results depend on the model and the options alone,
/// not on threads or `run`. Error (the model) where it does not fit into the memory.
Model bake_light(Model model, const LightOptions& options, const std::vector<glm::vec3>& reflectances,
                 const RunPoints& run, LightReport& report);

/// The irradiance (lux), and openness, of each point of a model that is refined already: what bake_light()
/// stores, before it is rounded.
struct PointLight {
  std::vector<glm::vec3> irradiance;
  std::vector<float> openness;
};
PointLight gather_points(const LitScene& scene, const LitScene& light_scene, const Emitters& emitters,
                         std::span<const LightPoint> points, const LightOptions& options,
                         const RunPoints& run);

/// LitSurface for each material.
std::vector<LitSurface> lit_surfaces(const Model& model, const std::vector<glm::vec3>& reflectances);

}  // namespace triptych
