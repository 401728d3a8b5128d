#include "render/gl/line_pass.hpp"

namespace triptych {

namespace {

const char* const vertex_source = R"(#version 450
struct Line { vec4 ends[2]; vec4 color; };
layout(std430, binding = 0) readonly buffer Lines { Line lines[]; };
out vec4 line_color;
void main() {
  gl_Position = lines[gl_VertexID / 2].ends[gl_VertexID % 2];
  line_color = lines[gl_VertexID / 2].color;
}
)";

const char* const fragment_source = R"(#version 450
in vec4 line_color;
layout(location = 0) out vec4 color;
void main() { color = line_color; }
)";

constexpr GLuint lines_binding = 0;
static_assert(sizeof(ScreenLine) == 48);

}  // namespace

void LinePass::draw(std::span<const ScreenLine> lines, const Framebuffer& framebuffer) {
  framebuffer.bind();
  draw(lines);
}

void LinePass::draw(std::span<const ScreenLine> lines) {
  if (lines.empty()) return;
  if (!program_) program_ = make_program("lines", vertex_source, fragment_source);
  lines_.upload(lines);
  glUseProgram(*program_);
  glBindVertexArray(vertex_array_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, lines_binding, lines_);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_ALWAYS);
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(2 * lines.size()));
  glDepthMask(GL_TRUE);
}

}  // namespace triptych
