#include "preprocess/light_stage.hpp"

#include "base/notice.hpp"
#include "light/bake.hpp"
#include "preprocess/light_units.hpp"
#include "scene/linear_light.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// What materials' textures reflect on the whole, linear: their last level has one texel, their mean.
std::vector<glm::vec3> mean_of_textures(const Model& model, const Textures& textures,
                                        const SpoolFile& texels) {
  const LinearLight& light = LinearLight::table();
  std::vector<glm::vec3> means;
  for (const Material& material : model.materials) {
    glm::vec3& mean = means.emplace_back(1.0f);
    if (material.texture == no_id || material.texture >= textures.of_images.size()) continue;
    const uint32_t texture = textures.of_images[material.texture].texture;
    if (texture == no_id) continue;
    const TextureLevel& last = textures.textures[texture].levels.back();
    const std::vector<std::byte> bytes = texels.read({last.offset, last.size});
    const Texel texel = decode_texels(bytes, 1, 1, model.images[material.texture].place).front();
    for (int k = 0; k < 3; ++k)
      mean[k] = static_cast<float>(light.of(texel[static_cast<size_t>(k)])) / LinearLight::most;
  }
  return means;
}

bool may_emit(const Model& model) {
  const auto& objects = model.source_objects;
  return !model.lights.empty() ||
         std::ranges::any_of(model.materials, [](auto& own) { return own.emission != glm::vec3(0); }) ||
         std::ranges::any_of(objects.objects, [&](const SourceObject& own) {
           return is_luminaire_type(objects.texts[own.type]);
         });
}

}  // namespace

Model bake_light_in_build(Model model, const BuildOptions& options, const Textures& textures,
                          const SpoolFile& texels, BuildWork& work, LightReport& report) {
  LightOptions light = options.light;
  light.memory = options.memory;
  if (light.bake && !may_emit(model)) {
    notice("no light is baked: the model has neither lights nor emissive surfaces nor luminaires");
    light.bake = false;
  }
  if (!light.any()) return model;
  LightUnits units(work);
  const RunPoints run = [&](const std::string& what, uint32_t count, const PointValues& of_item) {
    return units.run(what, count, of_item);
  };
  const bool wanted = light.bake;
  const std::vector<glm::vec3> reflectances = mean_of_textures(model, textures, texels);
  Model lit = bake_light(std::move(model), light, reflectances, run, report);
  if (wanted && !report.baked) notice("no light is baked: nothing that is placed gives light");
  return lit;
}

}  // namespace triptych
