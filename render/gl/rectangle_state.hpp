// The OpenGL state while rectangles are tested against a depth.
#pragma once

#include <glad/gl.h>

namespace triptych {

/// Depth is compared and not written; it is clamped at the near end, where a rectangle's plane may pass the
/// eye, and clipped at the far end. The destructor restores the state.
class RectangleState {
 public:
  /// program: with rectangle_vertex_shader(); width, height: of the target, pixels.
  RectangleState(GLuint program, int width, int height, GLenum comparison = GL_GEQUAL) {
    glUseProgram(program);
    constexpr float eighth_pixel = 0.25f;  // the screen is two units wide
    glUniform2f(glGetUniformLocation(program, "overlap"), eighth_pixel / static_cast<float>(width),
                eighth_pixel / static_cast<float>(height));
    glDepthMask(GL_FALSE);
    glDepthFunc(comparison);
    glEnable(GL_DEPTH_CLAMP);
    for (GLenum i = 0; i < 8; ++i) glEnable(GL_CLIP_DISTANCE0 + i);
  }
  ~RectangleState() {
    for (GLenum i = 0; i < 8; ++i) glDisable(GL_CLIP_DISTANCE0 + i);
    glDisable(GL_DEPTH_CLAMP);
    glDepthMask(GL_TRUE);
  }
  RectangleState(const RectangleState&) = delete;
  RectangleState& operator=(const RectangleState&) = delete;
};

}  // namespace triptych
