// X's headers define words that GoogleTest uses: hence a file of its own.
#include "tests/view/screen.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace triptych::test {

std::vector<uint8_t> pixels_of_window(int width, int height) {
  ::Display* const display = XOpenDisplay(nullptr);
  if (!display) return {};
  ::Window root = 0, parent = 0, *children = nullptr;
  unsigned count = 0;
  XQueryTree(display, DefaultRootWindow(display), &root, &parent, &children, &count);
  std::vector<uint8_t> pixels;
  for (unsigned i = 0; i < count && pixels.empty(); ++i) {
    XWindowAttributes attributes;
    if (!XGetWindowAttributes(display, children[i], &attributes) || attributes.map_state != IsViewable ||
        attributes.width != width || attributes.height != height)
      continue;
    XImage* const image = XGetImage(display, children[i], 0, 0, static_cast<unsigned>(width),
                                    static_cast<unsigned>(height), AllPlanes, ZPixmap);
    if (!image) continue;
    for (int y = height - 1; y >= 0; --y) {
      for (int x = 0; x < width; ++x) {
        const unsigned long pixel = XGetPixel(image, x, y);
        for (const unsigned shift : {16u, 8u, 0u}) pixels.push_back(static_cast<uint8_t>(pixel >> shift));
        pixels.push_back(255);
      }
    }
    XDestroyImage(image);
  }
  if (children) XFree(children);
  XCloseDisplay(display);
  return pixels;
}

}  // namespace triptych::test
