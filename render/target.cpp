#include "render/target.hpp"

#include "base/error.hpp"

namespace triptych {

Target::Target(TargetKind kind, int width, int height) : kind_(kind), width_(width), height_(height) {
  GLint limit = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
  if (width > limit || height > limit) fail("OpenGL", "{}x{} pixels are more than its limit of {}", width, height, limit);
  glTextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
  if (kind == TargetKind::depth_only) {
    glNamedFramebufferDrawBuffer(framebuffer_, GL_NONE);
  } else {
    glTextureStorage2D(color_, 1, kind == TargetKind::color ? GL_RGBA8 : GL_R32UI, width, height);
    glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, color_, 0);
    glNamedFramebufferReadBuffer(framebuffer_, GL_COLOR_ATTACHMENT0);
  }
  if (glCheckNamedFramebufferStatus(framebuffer_, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    fail("OpenGL", "a framebuffer of {}x{} is not complete", width, height);
  }
  check_gl("framebuffer");
}

void Target::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
}

void Target::clear() const {
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  const float far_away = 0;
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_away);
  const float background[4] = {0.86f, 0.90f, 0.95f, 1};
  const GLuint nothing[4] = {0, 0, 0, 0};
  if (kind_ == TargetKind::color) glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, background);
  if (kind_ == TargetKind::item) glClearNamedFramebufferuiv(framebuffer_, GL_COLOR, 0, nothing);
}

namespace {
template <typename Value>
std::vector<Value> read(const Target& target, GLenum format, GLenum type, size_t per_pixel) {
  target.bind();
  std::vector<Value> values(static_cast<size_t>(target.width()) * static_cast<size_t>(target.height()) * per_pixel);
  glReadPixels(0, 0, target.width(), target.height(), format, type, values.data());
  return values;
}
}  // namespace

std::vector<uint8_t> Target::read_colors() const { return read<uint8_t>(*this, GL_RGBA, GL_UNSIGNED_BYTE, 4); }
std::vector<uint32_t> Target::read_items() const { return read<uint32_t>(*this, GL_RED_INTEGER, GL_UNSIGNED_INT, 1); }
std::vector<float> Target::read_depths() const { return read<float>(*this, GL_DEPTH_COMPONENT, GL_FLOAT, 1); }

}  // namespace triptych
