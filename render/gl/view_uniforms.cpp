#include "render/gl/view_uniforms.hpp"

#include "visibility/cap_look.hpp"
#include "visibility/layer_offset.hpp"
#include "visibility/pixel_sides.hpp"
#include "visibility/shading.hpp"
#include "visibility/vertex_terms.hpp"

namespace triptych {

ViewUniforms::ViewUniforms(GLuint program)
    : frustum_(glGetUniformLocation(program, "frustum")),
      depth_(glGetUniformLocation(program, "depth")),
      sample_place_(glGetUniformLocation(program, "sample_place")),
      light_(glGetUniformLocation(program, "light")),
      layer_view_(glGetUniformLocation(program, "layer_view")),
      layer_step_(glGetUniformLocation(program, "layer_step")),
      snapping_(glGetUniformLocation(program, "snapping")),
      sides_(glGetUniformLocation(program, "sides")),
      side_normals_(glGetUniformLocation(program, "side_normals")),
      side_count_(glGetUniformLocation(program, "side_count")),
      stroke_width_(glGetUniformLocation(program, "stroke_width")) {}

void ViewUniforms::set(const FrameView& view, const SamplePlace& place) const {
  const auto [frustum, depth] = clip_terms(view, place);
  glUniform4f(frustum_, frustum.x, frustum.y, frustum.z, frustum.w);
  glUniform2f(depth_, depth.x, depth.y);
  if (sample_place_ >= 0) {
    const glm::vec2 pixels(place.pixels());
    glUniform2f(sample_place_, pixels.x, pixels.y);
  }
  if (layer_view_ >= 0) {
    const LayerOffset offset(view, LayerOffset::rest_of_snapping);
    const glm::vec2 pixels(place.pixels());
    glUniform4f(layer_view_, offset.focal_x, offset.focal_y, offset.axis_x - pixels.x,
                offset.axis_y - pixels.y);
    const double unit = view.clip.orthographic ? view.clip.unit : 1;
    glUniform4f(layer_step_, offset.step, offset.snapped, offset.parallel, static_cast<float>(unit));
    glUniform1f(snapping_, offset.snapping);
  }
  if (sides_ >= 0) {
    const PixelSides sides(view, place);
    const auto count = static_cast<GLsizei>(sides.all().size());
    glUniform4fv(sides_, count, &sides.all()[0].x);
    if (side_normals_ >= 0) glUniform3fv(side_normals_, count, &sides.normal(0).x);
    if (side_count_ >= 0) glUniform1i(side_count_, count);
    if (stroke_width_ >= 0) glUniform1i(stroke_width_, CapHatching(view.view().height).stroke_width());
  }
  if (light_ >= 0) {
    const glm::vec3 light = light_direction(view);
    glUniform3f(light_, light.x, light.y, light.z);
  }
}

}  // namespace triptych
