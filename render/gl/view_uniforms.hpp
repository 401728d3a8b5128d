// What a program that draws geometry is told of the frame.
#pragma once

#include "lod/frame_view.hpp"

#include <glad/gl.h>

namespace triptych {

/// The uniforms `frustum`, `depth`, `light`, `layer_view` and `layer_step` of shaders that draw geometry; the
/// last three where it has them.
class ViewUniforms {
 public:
  explicit ViewUniforms(GLuint program);
  /// The program must be in use.
  void set(const FrameView& view) const;

 private:
  GLint frustum_, depth_, light_, layer_view_, layer_step_;
};

}  // namespace triptych
