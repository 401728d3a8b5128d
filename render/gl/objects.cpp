#include "render/gl/objects.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace triptych {

namespace {
void attach(GLuint program, GLenum kind, const std::string& name, const std::string& source) {
  const GLuint shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (!compiled) {
    char log[2048] = "";
    glGetShaderInfoLog(shader, sizeof(log), nullptr, log);
    glDeleteShader(shader);
    fail("OpenGL", "the shader \"{}\" does not compile: {}", name, log);
  }
  glAttachShader(program, shader);
  glDeleteShader(shader);
}
}  // namespace

GlProgram make_program(const std::string& name, const std::string& vertex_source,
                       const std::string& fragment_source) {
  GlProgram program;
  attach(program, GL_VERTEX_SHADER, name, vertex_source);
  attach(program, GL_FRAGMENT_SHADER, name, fragment_source);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (!linked) {
    char log[2048] = "";
    glGetProgramInfoLog(program, sizeof(log), nullptr, log);
    fail("OpenGL", "the program \"{}\" does not link: {}", name, log);
  }
  return program;
}

void check_gl(const std::string& place) {
  if (const GLenum error = glGetError(); error != GL_NO_ERROR) {
    fail(place, "OpenGL reports {}",
         error == GL_OUT_OF_MEMORY ? "that its memory is full" : fmt::format("error {:#x}", error));
  }
}

void StreamBuffer::upload(std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (bytes.size() > capacity_) capacity_ = std::max(bytes.size(), capacity_ * 3 / 2);
  // A new store each time: draws that are still running keep the old one.
  glNamedBufferData(buffer_, static_cast<GLsizeiptr>(capacity_), nullptr, GL_STREAM_DRAW);
  glNamedBufferSubData(buffer_, 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

}  // namespace triptych
