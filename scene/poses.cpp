#include "scene/poses.hpp"

#include "base/clock.hpp"
#include "base/rounding.hpp"
#include "scene/transforms.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

/// Turned and evenly stretched alone: then what was well-conditioned in the instance still is.
bool is_similarity(const Affine& transform) {
  const double x = glm::dot(transform[0], transform[0]), y = glm::dot(transform[1], transform[1]),
               z = glm::dot(transform[2], transform[2]), most = std::max({x, y, z});
  const double skew = std::max({std::abs(glm::dot(transform[0], transform[1])),
                                std::abs(glm::dot(transform[1], transform[2])),
                                std::abs(glm::dot(transform[2], transform[0]))});
  constexpr double rounding = 1e-9;
  return most > 0 && std::isfinite(most) && most - std::min({x, y, z}) <= most * rounding &&
         skew <= most * rounding;
}

}  // namespace

Poses::Poses(const MovingParts& parts)
    : parts_(parts),
      poses_(std::make_unique<Pose[]>(parts.instances.size())),
      known_(std::make_unique<std::atomic<bool>[]>(parts.instances.size())) {}

void Poses::begin(double time, uint64_t number) {
  time_ = time;
  number_ = number;
  steps_ = nanoseconds_ = 0;
  for (size_t i = 0; i < parts_.instances.size(); ++i) known_[i] = false;
}

[[gnu::noinline]] void Poses::evaluate(uint32_t instance) const {
  const std::scoped_lock lock(mutex_);
  if (known_[instance].load(std::memory_order_relaxed)) return;
  const Stopwatch stopwatch;
  const NearestRounding rounding;
  const MovingInstance& of = parts_.instances[instance];
  Pose& pose = poses_[instance];
  pose.transform = transform_at(parts_.motion, of.joint, time_);
  const auto is_placeable = [](const Affine& transform) {
    return is_finite(transform) && well_conditioned(transform, max_condition);
  };
  pose.is_there = is_placeable(pose.transform);
  if (pose.is_there && !is_similarity(pose.transform)) {
    pose.is_there = std::ranges::all_of(of.inner, [&](uint32_t inner) {
      return is_placeable(pose.transform * glm::dmat4(parts_.transforms[inner].to_instance));
    });
  }
  steps_.fetch_add(1, std::memory_order_relaxed);
  nanoseconds_.fetch_add(static_cast<uint64_t>(1e6 * stopwatch.milliseconds()), std::memory_order_relaxed);
  known_[instance].store(true, std::memory_order_release);
}

bool Poses::is_there(SceneNodeId node) const {
  return pose(parts_.nodes[parts_.node_of[node]].instance).is_there;
}

/// Sums of products in one order: rounding keeps the order of numbers, so what is in a box stays in it.
[[gnu::noinline]] LatticeBox Poses::placed(const Lattice& lattice, uint32_t instance, const Box& box,
                                           const LatticeBox& swept) const {
  const NearestRounding rounding;
  if (!pose(instance).is_there) return swept;  // its numbers may be none
  const Affine& transform = pose(instance).transform;
  const Box outer = lattice.box(swept);
  Box placed;
  for (int axis = 0; axis < 3; ++axis) {
    double lo = transform[3][axis], hi = lo;
    for (int from = 0; from < 3; ++from) {
      const double a = transform[from][axis] * box.lo[from], b = transform[from][axis] * box.hi[from];
      lo += std::min(a, b);
      hi += std::max(a, b);
    }
    placed.lo[axis] = std::clamp(lo, outer.lo[axis], outer.hi[axis]);
    placed.hi[axis] = std::clamp(hi, outer.lo[axis], outer.hi[axis]);
  }
  const LatticeBox enclosing = lattice.enclosing(placed);
  // A step for rounding in the transform.
  return {glm::max(swept.lo, enclosing.lo - 1), glm::min(swept.hi, enclosing.hi + 1)};
}

LatticeBox Poses::box(const Lattice& lattice, SceneNodeId node, const LatticeBox& swept) const {
  const MovingNode& moving = parts_.nodes[parts_.node_of[node]];
  return placed(lattice, moving.instance, moving.box, swept);
}

LatticeBox Poses::instance_box(const Lattice& lattice, SceneNodeId node, const LatticeBox& swept) const {
  const uint32_t instance = parts_.nodes[parts_.node_of[node]].instance;
  return placed(lattice, instance, parts_.instances[instance].box, swept);
}

Affine Poses::transform(uint32_t transform, const Affine& otherwise) const {
  const uint32_t moving = parts_.transform_of[transform];
  if (moving == no_id) return otherwise;
  const MovingTransform& of = parts_.transforms[moving];
  return pose(of.instance).transform * glm::dmat4(of.to_instance);
}

std::shared_ptr<const Poses> poses_of(const Skeleton& skeleton, const FrameState& state) {
  if (!skeleton.moving) return nullptr;
  return skeleton.moving->poses_at(state.effects.has(Effect::motion) ? state.time : 0);
}

}  // namespace triptych
