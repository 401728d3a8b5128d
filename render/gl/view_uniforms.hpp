// What a program that draws geometry is told of the frame.
#pragma once

#include "lod/frame_view.hpp"
#include "scene/sample_places.hpp"

#include <glad/gl.h>

namespace triptych {

/// The uniforms `frustum`, `depth`, `sample_place`, `light`, `layer_view`, `layer_step` and `snapping` of
/// shaders that draw geometry, and those of sections: what they have of them.
class ViewUniforms {
 public:
  explicit ViewUniforms(GLuint program);
  /// The program must be in use.
  void set(const FrameView& view, const SamplePlace& place = {}) const;

 private:
  GLint frustum_, depth_, sample_place_, light_, layer_view_, layer_step_, snapping_, sides_, side_normals_,
      side_count_, stroke_width_;
};

}  // namespace triptych
