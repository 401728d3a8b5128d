#include "render/gl/framebuffer.hpp"

#include "base/error.hpp"
#include "visibility/shading.hpp"

#include <algorithm>

namespace triptych {

namespace {
constexpr GLenum color_attachment = GL_COLOR_ATTACHMENT0, item_attachment = GL_COLOR_ATTACHMENT1,
                 normal_attachment = GL_COLOR_ATTACHMENT2;
}  // namespace

Framebuffer::Framebuffer(TargetKind kind, int width, int height, const FramebufferLayout& layout)
    : kind_(kind), width_(width), height_(height), layout_(layout), planes_(layout.samples) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width > limit || height > limit)
    fail("OpenGL", "{}x{} pixels are more than its limit of {}", width, height, limit);
  if (layout.stencil) {
    attach(depth_, GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH32F_STENCIL8);
  } else {
    attach(depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
  }
  // A program writes its first output to the first of these.
  std::vector<GLenum> draw_buffers;
  const auto attach_drawn = [&](const GlTextureArray& texture, GLenum attachment, GLenum format) {
    attach(texture, attachment, format);
    draw_buffers.push_back(attachment);
  };
  if (has_colors()) attach_drawn(color_, color_attachment, GL_RGBA8);
  if (has_items()) attach_drawn(item_, item_attachment, GL_R32UI);
  if (has_colors() && layout.normals) attach_drawn(normal_, normal_attachment, GL_RGBA16);
  if (draw_buffers.empty()) draw_buffers.push_back(GL_NONE);
  for (const GlFramebuffer& plane : planes_) {
    glNamedFramebufferDrawBuffers(plane, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
    if (glCheckNamedFramebufferStatus(plane, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      fail("OpenGL", "a framebuffer of {}x{} is not complete", width, height);
  }
  check_gl("framebuffer");
}

void Framebuffer::attach(const GlTextureArray& texture, GLenum attachment, GLenum format) {
  glTextureStorage3D(texture, 1, format, width_, height_, static_cast<GLsizei>(planes_.size()));
  for (size_t i = 0; i < planes_.size(); ++i)
    glNamedFramebufferTextureLayer(planes_[i], attachment, texture, 0, static_cast<GLint>(i));
}

void Framebuffer::bind(uint32_t plane) const {
  glBindFramebuffer(GL_FRAMEBUFFER, planes_[plane]);
  glViewport(0, 0, width_, height_);
}

void Framebuffer::clear() const {
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float far_away = 0;
  const GLuint nothing[4] = {0, 0, 0, 0};
  for (const GlFramebuffer& plane : planes_) {
    if (layout_.stencil) {
      glClearNamedFramebufferfi(plane, GL_DEPTH_STENCIL, 0, far_away, winding_zero);
    } else {
      glClearNamedFramebufferfv(plane, GL_DEPTH, 0, &far_away);
    }
    if (has_colors()) glClearNamedFramebufferfv(plane, GL_COLOR, 0, background_color);
    if (has_items()) glClearNamedFramebufferuiv(plane, GL_COLOR, has_colors() ? 1 : 0, nothing);
  }
}

void Framebuffer::write_colors(std::span<const uint8_t> colors) {
  glTextureSubImage3D(color_, 0, 0, 0, 0, width_, height_, 1, GL_RGBA, GL_UNSIGNED_BYTE, colors.data());
}

void Framebuffer::copy_to_window(int window_width, int window_height) const {
  const GLuint window = 0;
  const int copied_width = std::min(width_, window_width), copied_height = std::min(height_, window_height);
  if (copied_width < window_width || copied_height < window_height) {
    glBindFramebuffer(GL_FRAMEBUFFER, window);
    glClearNamedFramebufferfv(window, GL_COLOR, 0, background_color);
  }
  glNamedFramebufferReadBuffer(planes_.front(), color_attachment);
  glBlitNamedFramebuffer(planes_.front(), window, 0, 0, copied_width, copied_height, 0, 0, copied_width,
                         copied_height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

namespace {
template <typename Value>
std::vector<Value> read(const Framebuffer& target, GLenum format, GLenum type, size_t per_pixel,
                        uint32_t plane = 0) {
  target.bind(plane);
  std::vector<Value> values(static_cast<size_t>(target.width()) * static_cast<size_t>(target.height()) *
                            per_pixel);
  glReadPixels(0, 0, target.width(), target.height(), format, type, values.data());
  return values;
}
}  // namespace

std::vector<uint8_t> Framebuffer::read_colors() const {
  glNamedFramebufferReadBuffer(planes_.front(), color_attachment);
  return read<uint8_t>(*this, GL_RGBA, GL_UNSIGNED_BYTE, 4);
}

std::vector<uint32_t> Framebuffer::read_items(uint32_t plane) const {
  glNamedFramebufferReadBuffer(planes_[plane], item_attachment);
  return read<uint32_t>(*this, GL_RED_INTEGER, GL_UNSIGNED_INT, 1, plane);
}

std::vector<float> Framebuffer::read_depths() const {
  return read<float>(*this, GL_DEPTH_COMPONENT, GL_FLOAT, 1);
}

}  // namespace triptych
