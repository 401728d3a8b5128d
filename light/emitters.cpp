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

void add_triangle(EmissiveBody& body, const LitModel& model, uint32_t triangle) {
  const double area = area_of(model, model.triangles[triangle]);
  if (!(area > 0)) return;
  body.triangles.push_back(triangle);
  body.areas.push_back((body.areas.empty() ? 0 : body.areas.back()) + area);
}

void set_sphere(EmissiveBody& body, const LitModel& model) {
  Box box;
  for (const uint32_t triangle : body.triangles)
    for (const LitCorner& corner : model.triangles[triangle].corners) box.extend(model.at(corner));
  body.middle = (box.lo + box.hi) * 0.5;
  body.radius = glm::distance(box.lo, box.hi) / 2;
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
  emitters.body_of.assign(model.instances.size(), no_id);
  for (uint32_t t = 0; t < lit.triangles.size(); ++t) {
    if (emitters.radiance(scene, t) == glm::dvec3(0)) continue;
    uint32_t& body = emitters.body_of[lit.triangles[t].instance];
    if (body == no_id) {
      body = static_cast<uint32_t>(emitters.bodies.size());
      emitters.bodies.emplace_back();
    }
    const size_t before = emitters.bodies[body].triangles.size();
    add_triangle(emitters.bodies[body], lit, t);
    if (emitters.bodies[body].triangles.size() == before) continue;
    emitters.bodies[body].power += luminance(emitters.radiance(scene, t)) * area_of(lit, lit.triangles[t]);
    ++emitters.emissive_triangles;
  }
  // Bodies whose triangles have no area give no light.
  for (uint32_t& body : emitters.body_of)
    if (body != no_id && emitters.bodies[body].triangles.empty()) body = no_id;
  for (EmissiveBody& body : emitters.bodies)
    if (!body.triangles.empty()) set_sphere(body, lit);
  return emitters;
}

}  // namespace triptych
