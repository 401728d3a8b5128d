// Makes the picture out of planes of samples, with edges where the frame state has them.
#pragma once

#include "lod/frame_view.hpp"
#include "render/gl/framebuffer.hpp"

#include <optional>

namespace triptych {

/// Each pixel is the mean of its samples' colours, in whole numbers, halves up, as on the device `cpu`; but
/// every sample was shaded by itself. Edges go by visibility/edge_rule.hpp, each sample beside the same
/// sample of its neighbours.
class ResolvePass {
 public:
  /// veils: of what is transparent over each plane (FragmentLists), or null. picture: colours alone, of the
  /// size of `planes`.
  void draw(const FrameView& view, const Framebuffer& planes, const GlTextureArray* veils,
            const Framebuffer& picture);

 private:
  std::optional<GlProgram> programs_[2][2][2];  ///< by edges, veils, projection; made when first used
  GlVertexArray vertex_array_;
};

}  // namespace triptych
