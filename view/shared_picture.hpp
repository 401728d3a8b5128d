// A picture in memory that the X server reads too: where OpenGL draws with the processor, the cheapest way of
// a finished picture into a window.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

struct GLFWwindow;

namespace triptych {

class SharedPicture {
 public:
  /// Null where there is no X server that shares this machine's memory and takes 32 bits a pixel, red first
  /// from above.
  static std::unique_ptr<SharedPicture> make(GLFWwindow* window);
  ~SharedPicture();
  SharedPicture(const SharedPicture&) = delete;
  SharedPicture& operator=(const SharedPicture&) = delete;

  /// Shows the window's picture, width × height of RGBA, rows from bottom to top, and returns when the server
  /// has read it. False where there is no memory to share; then nothing is shown.
  bool show(std::span<const uint8_t> colors, int width, int height);

 private:
  class Image;
  struct Screen;
  explicit SharedPicture(const Screen& screen);

  std::unique_ptr<Screen> screen_;
  std::unique_ptr<Image> image_;
};

}  // namespace triptych
