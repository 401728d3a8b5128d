// Pictures that were made without OpenGL, shown in a window.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

namespace triptych {

/// In the context that is current in this thread, a window's. Keeps its room for pictures of one size.
class WindowPicture {
 public:
  WindowPicture();
  ~WindowPicture();
  WindowPicture(const WindowPicture&) = delete;
  WindowPicture& operator=(const WindowPicture&) = delete;

  /// colors: width × height of RGBA, rows from bottom to top. Of a window of another size, what fits is
  /// shown; the rest is background.
  void show(std::span<const uint8_t> colors, int width, int height, int window_width, int window_height);

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace triptych
