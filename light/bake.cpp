#include "light/bake.hpp"

#include "base/notice.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "light/moving_groups.hpp"
#include "light/refine.hpp"
#include "light/sampling.hpp"
#include "model/flatten.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <optional>

namespace triptych {

namespace {

constexpr uint32_t floats_a_side = 5;  // red, green, blue, openness, share of backs

/// Which sides of points are worth a look.
struct Sides {
  std::vector<uint8_t> front, back;
};

/// The insides of closed surfaces are not, unless a light is in there: rays from them meet backs alone.
Sides sides_of(std::span<const LightPoint> points, const std::vector<float>& direct) {
  constexpr float mostly = 0.9f;
  Sides sides;
  uint32_t instances = 0;
  for (const LightPoint& point : points) instances = std::max(instances, point.instance + 1);
  std::vector<uint32_t> inside(instances, 0), lit_inside(instances, 0);
  const auto value = [&](size_t i, size_t side, size_t k) {
    return direct[(2 * i + side) * floats_a_side + k];
  };
  const auto is_inside = [&](size_t i, size_t side) {
    return value(i, side, 4) > mostly && value(i, 1 - side, 4) <= mostly;
  };
  for (size_t i = 0; i < points.size(); ++i) {
    for (const size_t side : {size_t{0}, size_t{1}}) {
      if (!is_inside(i, side)) continue;
      ++inside[points[i].instance];
      if (value(i, side, 0) + value(i, side, 1) + value(i, side, 2) > 0) ++lit_inside[points[i].instance];
    }
  }
  constexpr uint32_t leaks = 50;  // at seams: one of so many
  for (size_t i = 0; i < points.size(); ++i) {
    const bool all = lit_inside[points[i].instance] * leaks > inside[points[i].instance];
    sides.front.push_back(all || !is_inside(i, 0));
    sides.back.push_back(all || !is_inside(i, 1));
  }
  return sides;
}

/// LitSurface for each material.
std::vector<LitSurface> lit_surfaces(const Model& model, const std::vector<glm::vec3>& reflectances) {
  std::vector<LitSurface> surfaces;
  for (size_t i = 0; i < model.materials.size(); ++i) {
    const Material& material = model.materials[i];
    const bool gives_more = material.emitted != glm::vec3(0);
    const glm::vec3 texture = i < reflectances.size() ? reflectances[i] : glm::vec3(1);
    surfaces.push_back({glm::dvec3(glm::vec3(material.base_color) * texture),
                        glm::dvec3(gives_more ? material.emitted : material.emission) * emission_luminance,
                        static_cast<double>(material.base_color.a)});
  }
  return surfaces;
}

/// Of a model that is refined already.
PointLight gather_points(const LitScene& scene, const LitScene& light_scene, const Emitters& emitters,
                         std::span<const LightPoint> points, const LightOptions& options,
                         const RunPoints& run) {
  const Gatherer gatherer(scene, light_scene, emitters, options);
  const double clearance = scene.clearance();
  const auto count = static_cast<uint32_t>(points.size());
  const auto place = [&](uint32_t i, bool back, uint32_t pass) {
    return gather_place(
        points[i], back, clearance,
        options.seed ^ mixed_bits(uint64_t{i} << 16 | uint64_t{pass} << 1 | (back ? 1u : 0u)));
  };
  const std::vector<float> direct = run("direct light", count, [&](uint32_t i, std::vector<float>& values) {
    for (const bool back : {false, true}) {
      const DirectLight own = gatherer.direct(place(i, back, 0), options.samples, true);
      for (int k = 0; k < 3; ++k) values.push_back(static_cast<float>(own.irradiance[k]));
      values.push_back(static_cast<float>(own.openness));
      values.push_back(static_cast<float>(own.backs));
    }
  });
  const Sides sides = sides_of(points, direct);
  PointLight light;
  const auto of_side = [&](uint32_t i, bool back) {
    const float* const own = &direct[(2 * size_t{i} + (back ? 1 : 0)) * floats_a_side];
    return glm::vec4(own[0], own[1], own[2], own[3]);
  };
  const auto brightness = [](const glm::vec4& own) { return luminance(glm::dvec3(own.x, own.y, own.z)); };
  for (uint32_t i = 0; i < count; ++i) {
    const glm::vec4 front = of_side(i, false), back = of_side(i, true);
    const double gain = brightness(back) - brightness(front);
    const bool shows_back = sides.back[i] && (!sides.front[i] || gain > 0);
    const glm::vec4 own = shows_back ? back : front;
    light.irradiance.emplace_back(own);
    light.openness.push_back(own.w);
  }
  for (uint32_t bounce = 1; options.bake && bounce <= options.bounces; ++bounce) {
    const AreaSources bright = bright_surfaces(scene, light.irradiance);
    const std::vector<float> values = run(
        fmt::format("bounce {} of {}", bounce, options.bounces), count,
        [&](uint32_t i, std::vector<float>& added) {
          glm::vec4 best(0, 0, 0, -1);
          for (const bool back : {false, true}) {
            if (!(back ? sides.back : sides.front)[i]) continue;
            const glm::vec4 own =
                of_side(i, back) +
                glm::vec4(gatherer.bounced(place(i, back, bounce), options.samples, light.irradiance, bright),
                          0);
            const double gain = brightness(own) - brightness(best);
            if (best.w < 0 || gain > 0) best = own;
          }
          for (int k = 0; k < 4; ++k) added.push_back(best[k]);
        });
    for (uint32_t i = 0; i < count; ++i) {
      light.irradiance[i] = {values[4 * i], values[4 * i + 1], values[4 * i + 2]};
      light.openness[i] = std::max(values[4 * i + 3], 0.0f);
    }
  }
  return light;
}

}  // namespace

std::vector<float> run_points(const std::string& what, uint32_t count, const PointValues& of_item) {
  constexpr uint32_t block = 256;
  Progress progress(what, count);
  std::vector<std::vector<float>> blocks((count + block - 1) / block);
  parallel_for(blocks.size(), [&](size_t b) {
    const auto first = static_cast<uint32_t>(b) * block, end = std::min(count, first + block);
    for (uint32_t i = first; i < end; ++i) of_item(i, blocks[b]);
    progress.advance(end - first);
  });
  std::vector<float> values;
  for (const std::vector<float>& own : blocks) values.insert(values.end(), own.begin(), own.end());
  return values;
}

LightBake::LightBake(const Model& flat, const LightOptions& options,
                     const std::vector<glm::vec3>& reflectances, const RunPoints& run)
    : options_(options), surfaces_(lit_surfaces(flat, reflectances)) {
  source_ = place_all(flat, options.memory / 8);
  if (source_.triangles.empty() || !(source_.diagonal > 0)) options_.bake = options_.ambient = false;
  if (!options_.any()) return;
  source_scene_.emplace(source_, surfaces_);
  emitters_ = find_emitters(flat, *source_scene_);
  report_.lights = emitters_.lights.size();
  report_.emissive_triangles = emitters_.surfaces.triangles();
  report_.luminaires = emitters_.luminaire_count;
  options_.bake = options_.bake && emitters_.any();
  report_.baked = options_.bake;
  report_.ambient = options_.ambient;
  if (!options_.any()) return;
  report_.triangles = source_.triangles.size();
  report_.unshared_triangles = report_.triangles - std::min(report_.triangles, flat.source_triangles());
  model_ = source_;
  refine(model_, *source_scene_, emitters_, options_, run, report_);
  report_.refined_triangles = model_.triangles.size();
  points_ = make_points(model_, source_scene_->clearance());
  report_.points = points_.size();
  scene_.emplace(model_, surfaces_);
}

PointLight LightBake::gather(uint32_t samples, uint64_t seed, const RunPoints& run) const {
  LightOptions options = options_;
  options.samples = samples;
  options.seed = seed;
  return gather_points(*scene_, *source_scene_, emitters_, points_, options, run);
}

std::vector<VertexLight> encoded(const PointLight& light, double white, uint64_t& clipped_points) {
  std::vector<VertexLight> stored;
  clipped_points = 0;
  for (size_t i = 0; i < light.irradiance.size(); ++i) {
    VertexLight& own = stored.emplace_back();
    bool clipped = false;
    for (int k = 0; k < 3 && white > 0; ++k) {
      const auto relative = static_cast<float>(light.irradiance[i][k] / white);
      clipped = clipped || relative > most_irradiance;
      own[static_cast<size_t>(k)] = irradiance_byte(relative);
    }
    clipped_points += clipped;
    own[3] = openness_byte(light.openness[i]);
  }
  return stored;
}

Model bake_light(Model model, const LightOptions& options, const std::vector<glm::vec3>& reflectances,
                 const RunPoints& run, LightReport& report) {
  report = {};
  if (!options.any()) return model;
  MovingGroups moving = take_moving_groups(model);
  if (!moving.empty())
    notice("{} moving things keep the fixed light, and throw no shadow into what is baked",
           moving.instances.size());
  Model flat = flattened(model);
  const LightBake bake(flat, options, reflectances, run);
  report = bake.report();
  if (!bake.any()) {
    model.group_instances.insert(model.group_instances.end(), moving.instances.begin(),
                                 moving.instances.end());
    model.motion = std::move(moving.motion);
    return model;
  }
  model = {};
  const PointLight light = bake.gather(options.samples, options.seed, run);
  report.white_lux = report.baked ? white_irradiance(bake.model(), light.irradiance) : 0;
  const std::vector<VertexLight> stored = encoded(light, report.white_lux, report.clipped_points);
  Model lit = with_light(std::move(flat), bake.model(), stored);
  put_back(std::move(moving), lit);
  return lit;
}

}  // namespace triptych
