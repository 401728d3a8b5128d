#include "preprocess/light_stage.hpp"

#include "base/notice.hpp"
#include "light/bake.hpp"
#include "scene/linear_light.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <numeric>

namespace triptych {

namespace {

/// Points of one unit, and units of one batch: what a killed build loses at most.
constexpr uint32_t unit_points = 256, batch_units = 64;

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

/// Gathers in units, batch after batch.
class LightUnits {
 public:
  explicit LightUnits(BuildWork& work) : work_(work) {}

  std::vector<float> run(const std::string& what, uint32_t count, const PointValues& of_item) {
    const uint32_t units = (count + unit_points - 1) / unit_points;
    Progress progress(what, units);
    std::vector<float> values;
    for (uint32_t first = 0; first < units; first += batch_units) {
      std::vector<uint32_t> indices(std::min(batch_units, units - first));
      std::iota(indices.begin(), indices.end(), before_ + first);
      work_.run(
          UnitKind::light, indices,
          [&](uint32_t index) {
            std::vector<float> own;
            const uint32_t begin = (index - before_) * unit_points;
            for (uint32_t i = begin; i < std::min(count, begin + unit_points); ++i) of_item(i, own);
            return record_bytes(UnitResult{{}, {}, record_bytes(own)});
          },
          [&](uint32_t, const StoredUnit& stored) {
            const auto own = stored.figures_as<std::vector<float>>();
            values.insert(values.end(), own.begin(), own.end());
          },
          &progress);
    }
    before_ += units;
    return values;
  }

 private:
  BuildWork& work_;
  uint32_t before_ = 0;  ///< how many units came before, of other points
};

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
