#include "view/shared_picture.hpp"

#include "base/threads.hpp"

#include <X11/Xlib.h>
#include <X11/Xutil.h>
#include <X11/extensions/XShm.h>
#include <algorithm>
#include <bit>
#include <cstring>
#include <dlfcn.h>
#include <sys/ipc.h>
#include <sys/shm.h>

namespace triptych {

namespace {

/// What GLFW knows of X; null where the GLFW at hand is Wayland's, which has no such function.
template <typename Function>
Function* of_glfw(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_DEFAULT, name));
}

/// From RGBA to BGRX.
void write_row(const uint8_t* from, size_t width, char* to) {
  for (size_t x = 0; x < width; ++x) {
    uint32_t pixel;
    std::memcpy(&pixel, from + 4 * x, 4);
    pixel = (pixel & 0xff00ff00u) | ((pixel & 0xffu) << 16) | ((pixel >> 16) & 0xffu);
    std::memcpy(to + 4 * x, &pixel, 4);
  }
}

bool refused = false;
int note_refusal(Display*, XErrorEvent*) {
  refused = true;
  return 0;
}

}  // namespace

struct SharedPicture::Screen {
  Display* display;
  ::Window window;
  Visual* visual;
  unsigned depth;
  GC context;
};

/// A segment of memory that this process and the server have attached.
class SharedPicture::Image {
 public:
  Image(const Screen& screen, int width, int height) : display_(screen.display) {
    image_ = XShmCreateImage(display_, screen.visual, screen.depth, ZPixmap, nullptr, &segment_,
                             static_cast<unsigned>(width), static_cast<unsigned>(height));
    if (!image_) return;
    const size_t bytes = static_cast<size_t>(image_->bytes_per_line) * static_cast<size_t>(height);
    const int id = ::shmget(IPC_PRIVATE, bytes, IPC_CREAT | 0600);
    if (id < 0) return;
    void* const memory = ::shmat(id, nullptr, 0);
    if (memory != reinterpret_cast<void*>(-1)) {
      segment_.shmid = id;
      segment_.shmaddr = image_->data = static_cast<char*>(memory);
      segment_.readOnly = True;
      // A server on another machine says no by an error that ends the program otherwise.
      XSync(display_, False);
      refused = false;
      const auto before = XSetErrorHandler(note_refusal);
      const bool asked = XShmAttach(display_, &segment_) != 0;
      XSync(display_, False);
      XSetErrorHandler(before);
      attached_ = asked && !refused;
    }
    ::shmctl(id, IPC_RMID, nullptr);  // gone with the last of those that have it attached
  }
  ~Image() {
    if (attached_) {
      XShmDetach(display_, &segment_);
      XSync(display_, False);
    }
    if (segment_.shmaddr) ::shmdt(segment_.shmaddr);
    if (!image_) return;
    image_->data = nullptr;
    XDestroyImage(image_);
  }
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  bool stands() const { return attached_ && image_->bits_per_pixel == 32 && image_->byte_order == LSBFirst; }
  bool has_size(int width, int height) const {
    return image_ && image_->width == width && image_->height == height;
  }
  /// Pixels of RGBA, rows from bottom to top, become the server's: BGRX, rows from top to bottom.
  void write(const uint8_t* colors) {
    const auto width = static_cast<size_t>(image_->width), height = static_cast<size_t>(image_->height);
    constexpr size_t band = 64;  // rows
    parallel_for((height + band - 1) / band, [&](size_t i) {
      for (size_t row = i * band; row < std::min((i + 1) * band, height); ++row) {
        write_row(colors + (height - 1 - row) * width * 4, width,
                  image_->data + row * static_cast<size_t>(image_->bytes_per_line));
      }
    });
  }
  void put(const Screen& screen) {
    XShmPutImage(display_, screen.window, screen.context, image_, 0, 0, 0, 0,
                 static_cast<unsigned>(image_->width), static_cast<unsigned>(image_->height), False);
    XSync(display_, False);
  }

 private:
  Display* display_;
  XShmSegmentInfo segment_{};
  XImage* image_ = nullptr;
  bool attached_ = false;
};

SharedPicture::SharedPicture(const Screen& screen) : screen_(std::make_unique<Screen>(screen)) {}

SharedPicture::~SharedPicture() {
  image_.reset();
  XFreeGC(screen_->display, screen_->context);
}

std::unique_ptr<SharedPicture> SharedPicture::make(GLFWwindow* window) {
  static_assert(std::endian::native == std::endian::little);
  auto* const display_of = of_glfw<Display*()>("glfwGetX11Display");
  auto* const window_of = of_glfw<::Window(GLFWwindow*)>("glfwGetX11Window");
  if (!display_of || !window_of) return nullptr;
  Display* const display = display_of();
  if (!display || !XShmQueryExtension(display)) return nullptr;
  XWindowAttributes attributes;
  const ::Window of_x = window_of(window);
  if (!XGetWindowAttributes(display, of_x, &attributes)) return nullptr;
  const Visual& visual = *attributes.visual;
  if (visual.c_class != TrueColor || visual.red_mask != 0xff0000 || visual.green_mask != 0xff00 ||
      visual.blue_mask != 0xff)
    return nullptr;
  const Screen screen{display, of_x, attributes.visual, static_cast<unsigned>(attributes.depth),
                      XCreateGC(display, of_x, 0, nullptr)};
  return std::unique_ptr<SharedPicture>(new SharedPicture(screen));
}

bool SharedPicture::show(std::span<const uint8_t> colors, int width, int height) {
  if (!image_ || !image_->has_size(width, height)) {
    image_.reset();
    image_ = std::make_unique<Image>(*screen_, width, height);
  }
  if (!image_->stands()) return false;
  image_->write(colors.data());
  image_->put(*screen_);
  return true;
}

}  // namespace triptych
