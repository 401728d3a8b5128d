// The sky behind everything (visibility/sky_look.hpp).
#pragma once

#include "lod/frame_view.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/objects.hpp"
#include "visibility/effect_use.hpp"

#include <optional>

namespace triptych {

/// Compiled when it is first drawn.
class SkyPass {
 public:
  /// Replaces the colours of all planes, which have been cleared.
  EffectUse draw(const FrameView& view, const Framebuffer& planes);

 private:
  std::optional<GlProgram> program_;
  GlVertexArray vertex_array_;
};

}  // namespace triptych
