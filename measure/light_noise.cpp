#include "measure/light_noise.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "light/refine.hpp"
#include "model/flatten.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Of each point a third of what its triangles have.
std::vector<double> areas_of_points(const LightBake& bake) {
  std::vector<double> areas(bake.points().size(), 0);
  for (const LitTriangle& triangle : bake.model().triangles) {
    const double area = glm::length(bake.model().normal(triangle)) / 2;
    for (const LitCorner& corner : triangle.corners) areas[corner.point] += area / 3;
  }
  return areas;
}

}  // namespace

LightNoiseReport measure_light_noise(const Model& model, const LightOptions& options,
                                     const std::vector<uint32_t>& samples) {
  constexpr uint32_t reference_factor = 64;
  LightNoiseReport report;
  const Model flat = flattened(model);
  const Stopwatch refinement;
  const LightBake bake(flat, options, {}, run_points);
  if (!bake.any())
    fail(model.name(),
         "has nothing that gives light: neither lights, nor emissive surfaces, nor luminaires; "
         "--ambient measures ambient occlusion");
  report.light = bake.report();
  report.refinement_seconds = refinement.seconds();
  const std::vector<double> areas = areas_of_points(bake);
  double whole = 0;
  for (const double area : areas) whole += area;
  std::vector<PointLight> gathered;
  for (const uint32_t count : samples) {
    const Stopwatch stopwatch;
    gathered.push_back(bake.gather(count, options.seed, run_points));
    report.rows.push_back({count, stopwatch.seconds()});
  }
  report.reference_samples = reference_factor * *std::ranges::max_element(samples);
  const Stopwatch stopwatch;
  const PointLight reference = bake.gather(report.reference_samples, options.seed + 1, run_points);
  report.reference_seconds = stopwatch.seconds();
  const double white = white_irradiance(bake.model(), reference.irradiance);
  report.light.white_lux = white;
  for (size_t row = 0; row < gathered.size(); ++row) {
    double irradiance = 0, openness = 0;
    for (size_t i = 0; i < areas.size(); ++i) {
      const double off = luminance(glm::dvec3(gathered[row].irradiance[i] - reference.irradiance[i])),
                   open = gathered[row].openness[i] - reference.openness[i];
      irradiance += areas[i] * off * off;
      openness += areas[i] * open * open;
    }
    report.rows[row].rmse = white > 0 ? std::sqrt(irradiance / whole) / white : 0;
    report.rows[row].openness_rmse = std::sqrt(openness / whole);
  }
  return report;
}

}  // namespace triptych
