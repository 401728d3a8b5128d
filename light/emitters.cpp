#include "light/emitters.hpp"

#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

namespace triptych {

namespace {

/// What IFC calls the things that give light.
bool is_luminaire(const Model& model, const Instance& instance) {
  if (instance.object == no_id || instance.object >= model.source_objects.objects.size()) return false;
  return is_luminaire_type(model.source_objects.texts[model.source_objects.objects[instance.object].type]);
}

double area_of(const LitModel& model, const LitTriangle& triangle) {
  return glm::length(model.normal(triangle)) / 2;
}

}  // namespace

bool is_luminaire_type(std::string_view type) { return type == "IfcLightFixture" || type == "IfcLamp"; }

Emitters find_emitters(const Model& model, const LitScene& scene) {
  Emitters emitters;
  emitters.lights = model.lights;
  const LitModel& lit = scene.model();
  emitters.luminaires.assign(model.instances.size(), glm::dvec3(0));
  std::map<SourceObjectId, double> fixtures;  // the area of each
  std::vector<uint8_t> is_fixture(model.instances.size(), 0);
  for (uint32_t i = 0; i < model.instances.size(); ++i)
    is_fixture[i] = is_luminaire(model, model.instances[i]);
  for (const LitTriangle& triangle : lit.triangles) {
    if (is_fixture[triangle.instance])
      fixtures[model.instances[triangle.instance].object] += area_of(lit, triangle);
  }
  for (uint32_t i = 0; i < model.instances.size(); ++i) {
    if (!is_fixture[i]) continue;
    const double area = fixtures[model.instances[i].object];
    if (area > 0) emitters.luminaires[i] = glm::dvec3(luminaire_flux / (std::numbers::pi * area));
  }
  emitters.luminaire_count = fixtures.size();
  std::vector<float> luminances;
  for (uint32_t t = 0; t < lit.triangles.size(); ++t)
    luminances.push_back(static_cast<float>(luminance(emitters.radiance(scene, t))));
  emitters.surfaces = AreaSources(scene, std::move(luminances), 0);
  return emitters;
}

}  // namespace triptych
