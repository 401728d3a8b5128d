#include "render/gl/framebuffer.hpp"

#include "base/error.hpp"
#include "visibility/shading.hpp"

#include <algorithm>

namespace triptych {

namespace {
constexpr GLenum color_attachment = GL_COLOR_ATTACHMENT0, item_attachment = GL_COLOR_ATTACHMENT1;
}  // namespace

Framebuffer::Framebuffer(TargetKind kind, int width, int height)
    : kind_(kind), width_(width), height_(height) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width > limit || height > limit)
    fail("OpenGL", "{}x{} pixels are more than its limit of {}", width, height, limit);
  glTextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  if (has_colors()) attach(color_, color_attachment, GL_RGBA8);
  if (has_items()) attach(item_, item_attachment, GL_R32UI);
  // A program writes its first output to the first of these.
  const GLenum first = has_colors() ? color_attachment : has_items() ? item_attachment : GL_NONE;
  const GLenum draw_buffers[] = {first, kind == TargetKind::color_and_item ? item_attachment : GL_NONE};
  glNamedFramebufferDrawBuffers(framebuffer_, 2, draw_buffers);
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("OpenGL", "a framebuffer of {}x{} is not complete", width, height);
  }
  check_gl("framebuffer");
}

void Framebuffer::attach(const GlTexture& texture, GLenum attachment, GLenum format) {
  glTextureStorage2D(texture, 1, format, width_, height_);
  glNamedFramebufferTexture(framebuffer_, attachment, texture, 0);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
}

void Framebuffer::clear() const {
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float far_away = 0;
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_away);
  const GLuint nothing[4] = {0, 0, 0, 0};
  if (has_colors()) glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, background_color);
  if (has_items()) glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, has_colors() ? 1 : 0, nothing);
}

void Framebuffer::write_colors(std::span<const uint8_t> colors) {
  glTextureSubImage2D(color_, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, colors.data());
}

void Framebuffer::copy_to_window(int window_width, int window_height) const {
  const GLuint window = 0;
  const int copied_width = std::min(width_, window_width), copied_height = std::min(height_, window_height);
  if (copied_width < window_width || copied_height < window_height) {
    glBindFramebuffer(GL_FRAMEBUFFER, window);
    glClearNamedFramebufferfv(window, GL_COLOR, 0, background_color);
  }
  glNamedFramebufferReadBuffer(framebuffer_, color_attachment);
  glBlitNamedFramebuffer(framebuffer_, window, 0, 0, copied_width, copied_height, 0, 0, copied_width,
                         copied_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

namespace {
template <typename Value>
std::vector<Value> read(const Framebuffer& target, GLenum format, GLenum type, size_t per_pixel) {
  target.bind();
  std::vector<Value> values(static_cast<size_t>(target.width()) * static_cast<size_t>(target.height()) *
                            per_pixel);
  glReadPixels(0, 0, target.width(), target.height(), format, type, values.data());
  return values;
}
}  // namespace

std::vector<uint8_t> Framebuffer::read_colors() const {
  glNamedFramebufferReadBuffer(framebuffer_, color_attachment);
  return read<uint8_t>(*this, GL_RGBA, GL_UNSIGNED_BYTE, 4);
}

std::vector<uint32_t> Framebuffer::read_items() const {
  glNamedFramebufferReadBuffer(framebuffer_, item_attachment);
  return read<uint32_t>(*this, GL_RED_INTEGER, GL_UNSIGNED_INT, 1);
}

std::vector<float> Framebuffer::read_depths() const {
  return read<float>(*this, GL_DEPTH_COMPONENT, GL_FLOAT, 1);
}

}  // namespace triptych
