// The one-process fallback: a session's stages, one after the other, in one context.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/occlusion_stage.hpp"
#include "nodes/picture_stage.hpp"

namespace triptych {

/// How a run culls.
enum class CullMode {
  occlusion,  ///< V(i): the cut past the occlusion representation
  frustum,    ///< the whole cut
  none,       ///< the cut, and the rest of the model at the detail that its distance asks for
};

struct FallbackOptions {
  int width = 512, height = 512;
  CullMode cull = CullMode::occlusion;
  TestKind test = TestKind::storage;
  CullOptions batches;
  bool item_buffer = false;  ///< draw drawable ids instead of colours
};

/// Draws frames of a path, in order. A context must be current.
class Fallback {
 public:
  Fallback(const Pack& pack, const FallbackOptions& options);
  /// Draws the frame; the picture stays in target() until the next one.
  FrameRecord draw(const FrameRequest& frame);
  const Target& target() const { return picture_.target(); }
  /// Takes over from somebody else, who drew V(i−1).
  void resume(VisibleSet previous) { visible_ = std::move(previous); }
  /// For pictures of visible sets that come from elsewhere.
  PictureStage& picture() { return picture_; }
  /// Starts over, as if nothing had been drawn; the next frame is incoherent.
  void forget() { visible_.clear(); }

 private:
  FallbackOptions options_;
  Renderer renderer_;
  OcclusionStage occlusion_;
  PictureStage picture_;
  VisibleSet visible_;
};

}  // namespace triptych
