// Awkward little scenes with their packs, and camera paths through them: what culling and cuts are tried on.
#pragma once

#include "model/model.hpp"
#include "scene/camera.hpp"
#include "scene/pack.hpp"

#include <memory>
#include <random>
#include <string>
#include <vector>

namespace triptych::scenes {

/// The same numbers on every machine.
class Random {
 public:
  explicit Random(uint32_t seed) : generator_(seed) {}
  /// At least lo, below hi.
  double number(double lo = 0, double hi = 1) {
    return lo + (hi - lo) * (static_cast<double>(generator_()) * 0x1p-32);
  }
  uint32_t index(size_t count) { return static_cast<uint32_t>(generator_() % count); }
  glm::dvec3 vector(double lo = 0, double hi = 1) {
    const double x = number(lo, hi), y = number(lo, hi);
    return {x, y, number(lo, hi)};
  }

 private:
  std::mt19937 generator_;
};

/// Every scene by its name:
///   room       walls with a door, and many boxes behind them
///   flat       boxes without thickness, each its own bounding box
///   coplanar   boxes on a grid that share faces, and slabs of other colours that lie in those faces
///   slivers    long triangles of hardly any area
///   dust       objects below a pixel, before and behind a wall
///   world      one object as big as the world around all others
///   instances  one mesh placed often: turned, stretched, mirrored
///   sheared    one mesh under transforms whose axes nearly coincide, and flattened ones
///   far        the room, a million units from the origin
///   storeys    sub-hierarchies within sub-hierarchies: stacked, turned, stretched, mirrored
///   painted    meshes with vertex colours, smooth ones and ones with seams, among others without
///   glass      transparent panes, cases and spheres among opaque boxes, some of them flush with those
///   smooth     things that are round by the normals of their vertices, among faceted ones
///   textured   surfaces with textures, fences and leaves with holes before other things, textured glass, and
///              what glows (tests/support/textured_scene.hpp)
///   triangle   nothing but one triangle
const std::vector<std::string>& names();
Model make(const std::string& name);

/// The scene's pack, built with small leaves (dust: a box each) so that there is a hierarchy of some depth.
/// The same pack each time in one process; no file of it is left.
const Pack& pack(const std::string& name);
/// The same of a model in which each placement is an object (tests/support/object_sets.hpp).
const Pack& pack_with_objects(const std::string& name);
/// Writes the scene's pack to a file.
void write_pack(const std::string& name, const std::filesystem::path& file);
void write_pack_with_objects(const std::string& name, const std::filesystem::path& file);

/// A path that tries hard: small steps, turns, jumps, eyes inside boxes and on their faces, near planes that
/// cut boxes, wide, narrow and lopsided frustums, long lenses from far away, orthographic ones.
std::vector<View> path(const Skeleton& skeleton, int width, int height, uint32_t seed = 1);
/// The path's views at random alone, for tests that want many.
std::vector<View> random_views(const Skeleton& skeleton, int width, int height, size_t count, uint32_t seed);
/// Pixel errors for a path's frames, from half a pixel to eight.
double pixel_error(size_t frame);

}  // namespace triptych::scenes
