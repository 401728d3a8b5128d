// The sample `services`: a hospital whose storeys are full of building services: many small objects of few
// shared meshes, in rooms that are seen through doors and above walls. Meant as the worst case for occlusion
// culling.
#pragma once

#include <cstdint>
#include <filesystem>

namespace triptych {

inline constexpr int max_services_storeys = 100;

struct ServicesOptions {
  int storeys = 3;    ///< 1 to max_services_storeys; each has about 10,000 objects
  uint64_t seed = 1;  ///< decides everything: equal options give equal files
};

/// Of a quantity that many things have: the 5th, 50th and 95th percentile (nearest rank), and the largest.
struct Spread {
  double mean = 0;
  uint64_t p5 = 0, p50 = 0, p95 = 0, max = 0;
};

struct ServicesReport {
  size_t objects = 0, meshes = 0, unshared_meshes = 0, rooms = 0;
  uint64_t unique_triangles = 0, placed_triangles = 0;
  Spread triangles_per_object, uses_per_mesh;
};

/// Writes `scene.gltf`, `scene.bin`, `walk.json`, `fly.json`, `spin.json`, `jump.json` and `orbit.json`. Each
/// object is a node at the scene's top. Error for a number of storeys out of range.
ServicesReport make_services(const ServicesOptions& options, const std::filesystem::path& folder);

}  // namespace triptych
