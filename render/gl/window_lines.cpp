#include "render/window_lines.hpp"

#include "render/gl/line_pass.hpp"

namespace triptych {

struct WindowLines::Pass {
  LinePass lines;
};

WindowLines::WindowLines() : pass_(std::make_unique<Pass>()) {}
WindowLines::~WindowLines() = default;

void WindowLines::draw(std::span<const ScreenLine> lines, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width, height);
  pass_->lines.draw(lines);
}

}  // namespace triptych
