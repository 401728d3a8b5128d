#include "lod/clip_space.hpp"

#include "base/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {
/// Near planes are kept within this factor of the model's size: nothing of a model is that small, and floats
/// hold near / z for every z.
constexpr double near_limit = 0x1p60;
/// Room on both sides of an orthographic view's depths, as a share of the model's diagonal.
constexpr double depth_room = 0x1p-8;

ClipSpace compute(const Skeleton& skeleton, const View& view, const glm::dmat3& rotation, bool model_units) {
  const Camera& camera = view.camera;
  ClipSpace clip{.reference = camera.eye, .orthographic = camera.orthographic()};
  // Lattices have about 2^26 steps along the model's longest side.
  clip.unit = skeleton.lattice().step * 0x1p26;
  if (!model_units) clip.unit = 1;
  clip.near = std::clamp(camera.near, clip.unit / near_limit, clip.unit * near_limit);
  if (!clip.orthographic) return clip;

  const Box box = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  const glm::dvec3 forward = -glm::dvec3(rotation[0][2], rotation[1][2], rotation[2][2]);
  const double middle = glm::dot(forward, (box.lo + box.hi) * 0.5 - camera.eye);
  clip.reference_depth = std::max(0.0, middle);
  clip.reference = camera.eye + forward * clip.reference_depth;
  const double diagonal = std::max(skeleton.diagonal(), clip.unit);
  clip.near = std::max(clip.near, middle - diagonal * (0.5 + depth_room));
  clip.range = diagonal * (1 + 2 * depth_room);
  return clip;
}

}  // namespace

ClipSpace clip_space(const Skeleton& skeleton, const View& view, const glm::dmat3& rotation,
                     bool model_units) {
  return round_to_nearest([&] { return compute(skeleton, view, rotation, model_units); });
}

}  // namespace triptych
