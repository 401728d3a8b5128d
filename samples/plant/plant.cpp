#include "samples/plant/plant.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/progress.hpp"
#include "samples/gltf_writer.hpp"
#include "samples/plant/plant_parts.hpp"

#include <algorithm>

namespace triptych {
namespace {

/// Of all triangles, as in the model that this one follows: 6 million of 12.7.
constexpr double share_of_pipes = 0.4724;

// Streams of random numbers.
enum : uint64_t { for_places, for_machines, for_pipes, for_jump };

}  // namespace

PlantReport make_plant(const PlantOptions& options, const std::filesystem::path& folder) {
  if (options.triangles < min_plant_triangles || options.triangles > max_plant_triangles)
    fail("sample plant", "{} triangles; {} to {} can be made", options.triangles, min_plant_triangles,
         max_plant_triangles);
  const Random random(options.seed);
  PlantSite site(random.fork(for_places));
  PlantObjects objects;
  add_structure(objects, site);
  add_boilers(objects);
  add_turbines(objects);
  add_machines(objects, site, random.fork(for_machines));

  double weights = 0;
  for (const PlantObject& object : objects) weights += object.weight;
  const double scale = (1 - share_of_pipes) * static_cast<double>(options.triangles) / weights;
  PlantReport report;
  report.objects = objects.size() + 1;
  report.smallest_object = options.triangles;
  GltfWriter gltf(folder, "triptych sample plant");
  const auto counted = [&](uint64_t triangles) {
    report.triangles += triangles;
    report.smallest_object = std::min(report.smallest_object, triangles);
    report.largest_object = std::max(report.largest_object, triangles);
  };
  Progress progress("making objects", report.objects);
  for (const PlantObject& object : objects) {
    const auto budget = static_cast<uint64_t>(object.weight * scale);
    const MeshPart part = object.make(budget).mesh(budget);
    counted(part.indices.size() / 3);
    gltf.add_node(object.name, gltf.add_mesh(object.name, {part}), glm::dmat4(1));
    progress.advance();
  }
  // The pipes take what is left, so that the sum comes out.
  uint64_t pipes = 0, left = options.triangles - std::min(report.triangles, options.triangles);
  const auto make_service = [&](size_t service) {
    const uint64_t budget = left / (pipe_services - service);
    MeshPart part = make_pipes(site, service, budget, random.fork(for_pipes).fork(service)).mesh(budget);
    pipes += part.indices.size() / 3;
    left -= std::min<uint64_t>(left, part.indices.size() / 3);
    return part;
  };
  gltf.add_node("pipes", gltf.add_mesh("pipes", pipe_services, make_service), glm::dmat4(1));
  counted(pipes);
  progress.advance();
  gltf.finish();
  write_file(folder / "walk.json", path_json(plant_walk()));
  write_file(folder / "fly.json", path_json(plant_fly()));
  write_file(folder / "spin.json", path_json(plant_spin()));
  write_file(folder / "jump.json", path_json(plant_jump(random.fork(for_jump))));
  return report;
}

}  // namespace triptych
