#include "render/line_pass.hpp"

#include <array>
#include <glm/matrix.hpp>

namespace triptych {

namespace {

const char* const vertex_source = R"(#version 450
struct Vertex { vec4 position, color; };
layout(std430, binding = 0) readonly buffer Vertices { Vertex vertices[]; };
out vec4 line_color;
void main() {
  gl_Position = vertices[gl_VertexID].position;
  line_color = vertices[gl_VertexID].color;
}
)";

const char* const fragment_source = R"(#version 450
in vec4 line_color;
layout(location = 0) out vec4 color;
void main() { color = line_color; }
)";

constexpr GLuint vertices_binding = 0;

}  // namespace

LinePass::LinePass() : program_(make_program("lines", vertex_source, fragment_source)) {}

void LinePass::begin(const View& view) {
  view_ = view;
  rotation_ = view.rotation();
  lines_.clear();
}

void LinePass::add_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color) {
  const Camera& camera = view_.camera;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  for (const glm::dvec3* end : {&from, &to}) {
    const glm::dvec3 eye = rotation_ * (*end - camera.eye);
    lines_.push_back(
        {glm::vec4((2 * eye.x + (camera.right + camera.left) * eye.z) / width,
                   (2 * eye.y + (camera.top + camera.bottom) * eye.z) / height, camera.near, -eye.z),
         color});
  }
}

void LinePass::add_box(const Box& box, const glm::vec4& color) {
  for (int corner = 0; corner < 8; ++corner) {
    for (const int axis : {1, 2, 4}) {
      if ((corner & axis) == 0) add_line(box.corner(corner), box.corner(corner | axis), color);
    }
  }
}

void LinePass::add_frustum(const View& view, double depth, const glm::vec4& color) {
  const Camera& camera = view.camera;
  const glm::dmat3 to_model = glm::transpose(view.rotation());
  const auto at = [&](double x, double y, double distance) {
    const double spread = camera.orthographic() ? 1 : distance;
    return camera.eye + to_model * glm::dvec3(x * spread, y * spread, -distance);
  };
  const std::array<glm::dvec2, 4> sides = {glm::dvec2(camera.left, camera.bottom),
                                           {camera.right, camera.bottom},
                                           {camera.right, camera.top},
                                           {camera.left, camera.top}};
  for (size_t i = 0; i < sides.size(); ++i) {
    const glm::dvec2 here = sides[i], next = sides[(i + 1) % sides.size()];
    add_line(at(here.x, here.y, 0), at(here.x, here.y, depth), color);
    add_line(at(here.x, here.y, depth), at(next.x, next.y, depth), color);
  }
}

void LinePass::draw(const Target& target) {
  if (lines_.empty()) return;
  vertices_.upload(std::span<const Vertex>(lines_));
  target.bind();
  glUseProgram(program_);
  glBindVertexArray(vertex_array_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, vertices_binding, vertices_);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_ALWAYS);
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines_.size()));
  glDepthMask(GL_TRUE);
}

}  // namespace triptych
