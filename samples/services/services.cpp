#include "samples/services/services.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/progress.hpp"
#include "samples/gltf_writer.hpp"
#include "samples/services/building_services.hpp"
#include "samples/services/furnish_rooms.hpp"
#include "samples/services/services_paths.hpp"
#include "samples/services/structure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace triptych {
namespace {

// Streams of random numbers.
enum : uint64_t { for_plans, for_services, for_furniture, for_roof, for_walk, for_jump };

Spread spread_of(std::vector<uint64_t> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    const auto rank = static_cast<size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<size_t>(rank, 1) - 1];
  };
  const double sum = static_cast<double>(std::accumulate(values.begin(), values.end(), uint64_t{0}));
  return {sum / static_cast<double>(values.size()), at(0.05), at(0.5), at(0.95), values.back()};
}

WalkableStorey add_storey(ObjectScene& scene, int storey, const Random& random) {
  const auto key = static_cast<uint64_t>(storey);
  WalkableStorey result{plan_storey(storey, random.fork(for_plans).fork(key)), {}};
  add_structure(scene, result.rooms, storey);
  for (int corridor = 0; corridor < 2; ++corridor) add_corridor_services(scene, storey, corridor);
  for (size_t i = 0; i < result.rooms.size(); ++i) {
    const HospitalRoom& room = result.rooms[i];
    if (room.use == RoomUse::shaft) add_shaft_services(scene, room);
    if (room.use == RoomUse::shaft || room.use == RoomUse::stairs) continue;
    add_room_services(scene, room, random.fork(for_services).fork(key).fork(i));
    furnish_room(scene, room, random.fork(for_furniture).fork(key).fork(i));
  }
  result.obstacles = scene.obstacles(storey);
  return result;
}

ServicesReport report_of(const ObjectScene& scene, const std::vector<WalkableStorey>& storeys) {
  const std::vector<uint64_t> uses = scene.uses_of_meshes(), &triangles = scene.triangles_of_objects();
  ServicesReport report;
  report.objects = triangles.size();
  report.meshes = uses.size();
  report.unshared_meshes = static_cast<size_t>(std::count(uses.begin(), uses.end(), uint64_t{1}));
  for (const WalkableStorey& storey : storeys) report.rooms += storey.rooms.size();
  report.unique_triangles = scene.unique_triangles();
  report.placed_triangles = std::accumulate(triangles.begin(), triangles.end(), uint64_t{0});
  report.triangles_per_object = spread_of(triangles);
  report.uses_per_mesh = spread_of(uses);
  return report;
}

}  // namespace

ServicesReport make_services(const ServicesOptions& options, const std::filesystem::path& folder) {
  if (options.storeys < 1 || options.storeys > max_services_storeys)
    fail("sample services", "{} storeys; 1 to {} can be made", options.storeys, max_services_storeys);
  const Random random(options.seed);
  GltfWriter gltf(folder, "triptych sample services");
  ObjectScene scene(gltf, options.storeys);
  std::vector<WalkableStorey> storeys;
  Progress progress("making storeys", static_cast<size_t>(options.storeys));
  for (int storey = 0; storey < options.storeys; ++storey) {
    storeys.push_back(add_storey(scene, storey, random));
    progress.advance();
  }
  add_roof_and_ground(scene, options.storeys, random.fork(for_roof));
  const CameraFrames walk = services_walk(storeys, random.fork(for_walk));
  gltf.finish();
  write_file(folder / "walk.json", path_json(walk));
  write_file(folder / "fly.json", path_json(services_fly(options.storeys)));
  write_file(folder / "spin.json", path_json(services_spin(storeys)));
  write_file(folder / "jump.json", path_json(services_jump(storeys, random.fork(for_jump))));
  write_file(folder / "orbit.json", path_json(services_orbit(options.storeys)));
  return report_of(scene, storeys);
}

}  // namespace triptych
