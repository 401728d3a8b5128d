// Draws lines over a picture.
#pragma once

#include "render/gl/framebuffer.hpp"
#include "visibility/screen_lines.hpp"

#include <optional>
#include <span>

namespace triptych {

/// Draws over the framebuffer's colours, without a depth test: boxes of culled drawables lie behind
/// something, and must be seen nevertheless.
class LinePass {
 public:
  void draw(std::span<const ScreenLine> lines, const Framebuffer& framebuffer);
  /// Over what is bound, with its viewport.
  void draw(std::span<const ScreenLine> lines);

 private:
  std::optional<GlProgram> program_;  ///< made when lines are first drawn
  GlVertexArray vertex_array_;
  StreamBuffer lines_;
};

}  // namespace triptych
