// Where moving instances are at one time: evaluated where it is asked for.
#pragma once

#include "scene/frame_state.hpp"
#include "scene/moving_parts.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>

namespace triptych {

/// A function of the pack and the time alone. An instance is evaluated once, when something of it is first
/// asked for; what nobody asks for is not. Safe to ask from several threads.
class Poses {
 public:
  explicit Poses(const MovingParts& parts);
  /// Forgets what was evaluated. number: another one each time.
  void begin(double time, uint64_t number);

  double time() const { return time_; }
  /// Tells these poses from all others of the same parts.
  uint64_t number() const { return number_; }

  bool moves(SceneNodeId node) const { return parts_.node_of[node] != no_id; }
  /// Whether floats can place it where it is: what a motion shrinks to nothing or shears beyond that
  /// (max_condition) is not there. Of a scene node that moves.
  bool is_there(SceneNodeId node) const;
  /// A box that holds a scene node that moves, on the model's lattice; within that of its parent, and within
  /// `swept`, the skeleton's.
  LatticeBox box(const Lattice& lattice, SceneNodeId node, const LatticeBox& swept) const;
  /// The same of the whole instance that the node is of.
  LatticeBox instance_box(const Lattice& lattice, SceneNodeId node, const LatticeBox& swept) const;
  /// Of a chunk's positions to the model; otherwise: of one that does not move.
  Affine transform(uint32_t transform, const Affine& otherwise) const;

  /// How many instances have been evaluated.
  uint64_t steps() const { return steps_.load(std::memory_order_relaxed); }
  /// How long that took, wall clock.
  double milliseconds() const { return 1e-6 * static_cast<double>(nanoseconds_.load()); }

  /// As BuildRules::max_condition: what placed instances may be.
  static constexpr double max_condition = 8;

 private:
  struct Pose {
    Affine transform{1};
    bool is_there = false;
  };
  const Pose& pose(uint32_t instance) const {
    if (!known_[instance].load(std::memory_order_acquire)) evaluate(instance);
    return poses_[instance];
  }
  void evaluate(uint32_t instance) const;
  LatticeBox placed(const Lattice& lattice, uint32_t instance, const Box& box, const LatticeBox& swept) const;

  const MovingParts& parts_;
  double time_ = 0;
  uint64_t number_ = 0;
  mutable std::mutex mutex_;
  mutable std::unique_ptr<Pose[]> poses_;
  mutable std::unique_ptr<std::atomic<bool>[]> known_;
  mutable std::atomic<uint64_t> steps_ = 0, nanoseconds_ = 0;
};

/// Of what moves in a frame, which without Effect::motion stays where it is at time 0; null where nothing
/// does.
std::shared_ptr<const Poses> poses_of(const Skeleton& skeleton, const FrameState& state);

}  // namespace triptych
