// Light baked into the vertices of a model: a step from model to model, before levels are made.
#pragma once

#include "light/gather.hpp"
#include "light/light_options.hpp"
#include "light/run_points.hpp"
#include "model/model.hpp"
#include "scene/vertex_light.hpp"

#include <optional>
#include <vector>

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

/// The irradiance (lux), and openness, of each point: what bake_light() stores, before it is rounded.
struct PointLight {
  std::vector<glm::vec3> irradiance;
  std::vector<float> openness;
};

/// bake_light() step by step.
class LightBake {
 public:
  /// Finds the emitters, and refines. flat: without groups.
  LightBake(const Model& flat, const LightOptions& options, const std::vector<glm::vec3>& reflectances,
            const RunPoints& run);
  LightBake(const LightBake&) = delete;
  LightBake& operator=(const LightBake&) = delete;

  /// Whether there is anything to gather.
  bool any() const { return options_.any(); }
  const LitModel& model() const { return model_; }  ///< refined
  const std::vector<LightPoint>& points() const { return points_; }
  const LightReport& report() const { return report_; }
  /// At the points of the model, with so many samples; seed: of their directions.
  PointLight gather(uint32_t samples, uint64_t seed, const RunPoints& run) const;

 private:
  LightOptions options_;  ///< of what there is
  std::vector<LitSurface> surfaces_;
  LitModel source_, model_;
  std::optional<LitScene> source_scene_, scene_;
  Emitters emitters_;
  std::vector<LightPoint> points_;
  LightReport report_;
};

/// As vertices hold it; white: the irradiance under which a white surface shows as white, 0 without any.
std::vector<VertexLight> encoded(const PointLight& light, double white, uint64_t& clipped_points);

}  // namespace triptych
