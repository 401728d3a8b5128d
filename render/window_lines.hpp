// Lines over what stands in a window.
#pragma once

#include "visibility/screen_lines.hpp"

#include <memory>
#include <span>

namespace triptych {

/// In the context that is current in this thread, a window's.
class WindowLines {
 public:
  WindowLines();
  ~WindowLines();
  WindowLines(const WindowLines&) = delete;
  WindowLines& operator=(const WindowLines&) = delete;

  /// Over a picture of width × height pixels in the window's lower left corner.
  void draw(std::span<const ScreenLine> lines, int width, int height);

 private:
  struct Pass;
  std::unique_ptr<Pass> pass_;
};

}  // namespace triptych
