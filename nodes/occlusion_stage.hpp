// What a switch node does with its graphics card: draw the next occlusion representation, then cull against
// it.
#pragma once

#include "render/gl_occlusion_tester.hpp"
#include "visibility/hardware_cull.hpp"

#include <optional>

namespace triptych {

/// A frame as the render node asks for it.
struct FrameRequest {
  uint32_t number = 0;
  View view;
  double pixel_error = 1;
};

/// Holds R(i) from begin() until the next begin(): first as OR, then as HC. The fallback and the switch nodes
/// run this same code.
class OcclusionStage {
 public:
  OcclusionStage(Renderer& renderer, int width, int height, TestKind test);

  /// OR, start: selects cut i and empties R(i). The viewport must be the stage's size.
  void begin(const FrameRequest& frame);
  /// OR: draws what of V(i−1) was decided, mapped to cut i. May be called as packets come.
  void represent(const VisibleSet& visible);
  /// Waits until everything is drawn, so that a wall clock can time it.
  void finish();

  /// HC: culls cut i against R(i). previous: V(i−1).
  CullResult cull(const VisibleSet& previous, const CullOptions& options,
                  const std::function<void(const CullPacket&)>& emit);

  const Cut& cut() const { return cut_; }
  const FrameRequest& frame() const { return frame_; }
  /// Drawables in R(i), as begin() and represent() drew them.
  const std::vector<DrawableId>& represented() const { return represented_; }
  uint64_t represented_triangles() const;

 private:
  Renderer& renderer_;
  const Skeleton& skeleton_;
  GlOcclusionTester tester_;
  FrameRequest frame_;
  std::optional<View> last_view_;  ///< of the frame before, for the fault of a stale camera
  Cut cut_;
  std::vector<DrawableId> represented_;
  std::vector<bool> is_represented_;
};

}  // namespace triptych
