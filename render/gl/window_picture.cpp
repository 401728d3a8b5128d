#include "render/window_picture.hpp"

#include "render/gl/framebuffer.hpp"

#include <cassert>
#include <optional>

namespace triptych {

struct WindowPicture::Kept {
  std::optional<Framebuffer> framebuffer;
};

WindowPicture::WindowPicture() : kept_(std::make_unique<Kept>()) {}
WindowPicture::~WindowPicture() = default;

void WindowPicture::show(std::span<const uint8_t> colors, int width, int height, int window_width,
                         int window_height) {
  assert(colors.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * 4);
  std::optional<Framebuffer>& framebuffer = kept_->framebuffer;
  if (!framebuffer || framebuffer->width() != width || framebuffer->height() != height)
    framebuffer.emplace(TargetKind::color, width, height);
  framebuffer->write_colors(colors);
  framebuffer->copy_to_window(window_width, window_height);
}

}  // namespace triptych
