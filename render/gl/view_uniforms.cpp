#include "render/gl/view_uniforms.hpp"

#include "visibility/shading.hpp"
#include "visibility/vertex_terms.hpp"

namespace triptych {

ViewUniforms::ViewUniforms(GLuint program)
    : frustum_(glGetUniformLocation(program, "frustum")),
      depth_(glGetUniformLocation(program, "depth")),
      sample_place_(glGetUniformLocation(program, "sample_place")),
      light_(glGetUniformLocation(program, "light")) {}

void ViewUniforms::set(const FrameView& view, const SamplePlace& place) const {
  const auto [frustum, depth] = clip_terms(view, place);
  glUniform4f(frustum_, frustum.x, frustum.y, frustum.z, frustum.w);
  glUniform2f(depth_, depth.x, depth.y);
  if (sample_place_ >= 0) {
    const glm::vec2 pixels(place.pixels());
    glUniform2f(sample_place_, pixels.x, pixels.y);
  }
  if (light_ >= 0) {
    const glm::vec3 light = light_direction(view);
    glUniform3f(light_, light.x, light.y, light.z);
  }
}

}  // namespace triptych
