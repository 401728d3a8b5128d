// Owners of OpenGL objects, and helpers that every pass needs.
#pragma once

#include <cstddef>
#include <glad/gl.h>
#include <span>
#include <string>
#include <utility>

namespace triptych {

/// Owns one OpenGL object, made and deleted by the given functions.
template <void (*make)(GLuint*), void (*remove)(GLuint)>
class GlObject {
 public:
  GlObject() { make(&name_); }
  ~GlObject() {
    if (name_) remove(name_);
  }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  operator GLuint() const { return name_; }

 private:
  GLuint name_ = 0;
};

namespace gl_functions {
inline void make_buffer(GLuint* name) { glCreateBuffers(1, name); }
inline void remove_buffer(GLuint name) { glDeleteBuffers(1, &name); }
inline void make_vertex_array(GLuint* name) { glCreateVertexArrays(1, name); }
inline void remove_vertex_array(GLuint name) { glDeleteVertexArrays(1, &name); }
inline void make_framebuffer(GLuint* name) { glCreateFramebuffers(1, name); }
inline void remove_framebuffer(GLuint name) { glDeleteFramebuffers(1, &name); }
inline void make_texture(GLuint* name) { glCreateTextures(GL_TEXTURE_2D, 1, name); }
inline void make_texture_array(GLuint* name) { glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, name); }
inline void remove_texture(GLuint name) { glDeleteTextures(1, &name); }
inline void make_program(GLuint* name) { *name = glCreateProgram(); }
inline void remove_program(GLuint name) { glDeleteProgram(name); }
}  // namespace gl_functions

using GlBuffer = GlObject<gl_functions::make_buffer, gl_functions::remove_buffer>;
using GlVertexArray = GlObject<gl_functions::make_vertex_array, gl_functions::remove_vertex_array>;
using GlFramebuffer = GlObject<gl_functions::make_framebuffer, gl_functions::remove_framebuffer>;
using GlTexture = GlObject<gl_functions::make_texture, gl_functions::remove_texture>;
using GlTextureArray = GlObject<gl_functions::make_texture_array, gl_functions::remove_texture>;
using GlProgram = GlObject<gl_functions::make_program, gl_functions::remove_program>;

/// Compiles and links; Error with the driver's log where that fails.
GlProgram make_program(const std::string& name, const std::string& vertex_source,
                       const std::string& fragment_source);

/// Error (place) if OpenGL reports one; out of memory above all.
void check_gl(const std::string& place);

/// A buffer whose contents are replaced on each use; it grows where needed and never shrinks.
class StreamBuffer {
 public:
  void upload(std::span<const std::byte> bytes);
  template <typename Value>
  void upload(std::span<const Value> values) {
    upload(std::as_bytes(values));
  }
  operator GLuint() const { return buffer_; }

 private:
  GlBuffer buffer_;
  size_t capacity_ = 0;
};

}  // namespace triptych
