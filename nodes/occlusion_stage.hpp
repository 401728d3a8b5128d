// What a switch node does with its device: build the next occlusion representation, then run the strategy
// against it.
#pragma once

#include "lod/hierarchy.hpp"
#include "scene/frame_state.hpp"
#include "visibility/device.hpp"
#include "visibility/strategy.hpp"

#include <optional>

namespace triptych {

/// Holds R(i) from begin() until the next begin(): first as OR, then as HC. The local pipeline and the switch
/// nodes run this same code, with any strategy; one that has no representation leaves OR idle.
class OcclusionStage {
 public:
  /// All but the rules must outlive it.
  OcclusionStage(const Skeleton& skeleton, FrameTarget& target, Strategy& strategy, const FrameRules& rules);

  /// OR, start: frame i. The viewport must be the target's size: Error (place: frame target) otherwise.
  void begin(const FrameRequest& frame);
  /// OR: draws those drawables of V(i−1) that are decided, mapped to cut i. May be called as packets arrive.
  void represent(const VisibleSet& visible);
  /// Waits until everything is drawn, so that a wall clock can time it.
  void finish();

  /// HC: chooses V(i). previous: V(i−1). The result is valid until the next call.
  const CullResult& cull(const VisibleSet& previous, CullSink& sink);

  const FrameView& view() const { return *view_; }
  /// Drawables in R(i), as represent() drew them.
  std::span<const DrawableId> represented() const;
  uint64_t represented_triangles() const;

 private:
  const Skeleton& skeleton_;
  Strategy& strategy_;
  FrameRules rules_;
  FrameTarget& target_;
  uint32_t frame_ = 0;
  std::optional<FrameView> view_;
  std::optional<View> last_camera_;
  std::optional<double> last_time_;  ///< of the frame before
};

}  // namespace triptych
