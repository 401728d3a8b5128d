// Draws lines over a picture.
#pragma once

#include "render/gl/framebuffer.hpp"
#include "visibility/screen_lines.hpp"

#include <optional>
#include <span>

namespace triptych {

/// Over whatever stands in a framebuffer, without a depth test: what was culled lies behind something, and is
/// what one wants to see.
class LinePass {
 public:
  void draw(std::span<const ScreenLine> lines, const Framebuffer& framebuffer);

 private:
  std::optional<GlProgram> program_;  ///< once there are lines
  GlVertexArray vertex_array_;
  StreamBuffer lines_;
};

}  // namespace triptych
