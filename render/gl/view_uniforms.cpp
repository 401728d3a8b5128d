#include "render/gl/view_uniforms.hpp"

#include <glm/geometric.hpp>

namespace triptych {

namespace {
const glm::dvec3 light_in_model = glm::normalize(glm::dvec3(0.35, 0.85, 0.40));
}  // namespace

ViewUniforms::ViewUniforms(GLuint program)
    : frustum_(glGetUniformLocation(program, "frustum")),
      depth_(glGetUniformLocation(program, "depth")),
      light_(glGetUniformLocation(program, "light")) {}

void ViewUniforms::set(const FrameView& view) const {
  const Camera& camera = view.view().camera;
  const ClipSpace& clip = view.clip;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  const double shift_x = (camera.right + camera.left) / width,
               shift_y = (camera.top + camera.bottom) / height;
  const double scale = clip.orthographic ? 2 * clip.unit : 2;  // sides are tangents, or model units
  const double side = clip.orthographic ? -1 : 1;              // shifts go with −z, or with 1
  glUniform4f(frustum_, static_cast<float>(scale / width), static_cast<float>(scale / height),
              static_cast<float>(side * shift_x), static_cast<float>(side * shift_y));
  if (clip.orthographic) {
    glUniform2f(depth_, static_cast<float>(clip.unit / clip.range),
                static_cast<float>(clip.depth(clip.reference_depth)));
  } else {
    glUniform2f(depth_, static_cast<float>(clip.near / clip.unit), 0);
  }
  if (light_ >= 0) {
    const glm::vec3 light(view.rotation * light_in_model);
    glUniform3f(light_, light.x, light.y, light.z);
  }
}

}  // namespace triptych
