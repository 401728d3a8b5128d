#include "view/window.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "nodes/device_choice.hpp"
#include "raster/lines.hpp"
#include "render/gl_device.hpp"
#include "render/window_lines.hpp"
#include "render/window_picture.hpp"
#include "view/keys.hpp"
#include "view/shared_picture.hpp"
#include "view/typed_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <utility>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace triptych {

namespace {

const std::string place = "window";

std::string& last_trouble() {
  static std::string text;
  return text;
}

/// GLFW itself, started and ended.
class Library {
 public:
  Library() {
    glfwSetErrorCallback([](int, const char* text) { last_trouble() = text; });
    if (!glfwInit()) {
      fail(place, "there is no display to open it on ({}); `triptych render` draws without one",
           last_trouble());
    }
  }
  ~Library() { glfwTerminate(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

/// A direction and the keys that go there; opposite ones cancel out.
struct Direction {
  double WalkerMotion::*axis;
  double sign;
  std::vector<int> keys;
};
const std::vector<Direction>& directions() {
  static const std::vector<Direction> all = {{&WalkerMotion::forward, 1, {GLFW_KEY_W, GLFW_KEY_UP}},
                                             {&WalkerMotion::forward, -1, {GLFW_KEY_S, GLFW_KEY_DOWN}},
                                             {&WalkerMotion::right, 1, {GLFW_KEY_D, GLFW_KEY_RIGHT}},
                                             {&WalkerMotion::right, -1, {GLFW_KEY_A, GLFW_KEY_LEFT}},
                                             {&WalkerMotion::up, 1, {GLFW_KEY_E, GLFW_KEY_SPACE}},
                                             {&WalkerMotion::up, -1, {GLFW_KEY_Q, GLFW_KEY_LEFT_SHIFT}}};
  return all;
}

class WindowContext : public Context {
 public:
  WindowContext() { load(glfwGetProcAddress, place); }
};

}  // namespace

class Window::Implementation {
 public:
  explicit Implementation(const WindowOptions& options) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    if (options.context) {
      glfwWindowHint(GLFW_CONTEXT_CREATION_API,
                     *options.context == ContextKind::egl ? GLFW_EGL_CONTEXT_API : GLFW_OSMESA_CONTEXT_API);
    }
    window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
    if (!window) fail(place, "cannot be opened with OpenGL 4.5: {}", last_trouble());
    glfwSetWindowUserPointer(window, this);
    glfwMakeContextCurrent(window);
    glfwSwapInterval(0);
    context.emplace();
    if (!is_graphics_card(context->names())) shared = SharedPicture::make(window);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
      of(w).on_key(key, action, modifiers);
    });
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned code) { of(w).on_letter(code); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { of(w).on_wheel(y); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).on_cursor(x, y); });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
      of(w).on_button(button, action, modifiers);
    });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).input.resized = true; });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).input.damaged = true; });
  }
  ~Implementation() {
    shared.reset();
    if (window) glfwDestroyWindow(window);
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  Input poll(double patience) {
    const bool was_moving = moving;
    if (was_moving || patience <= 0 || !clicked.empty()) {
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(patience);
    }
    Input now = clicked.empty() ? std::exchange(input, {}) : std::move(clicked.front());
    if (!clicked.empty()) clicked.pop_front();
    moving = false;
    // With Ctrl held, letters and Shift are parts of commands.
    const bool walks = !reads_text && !holds(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    for (const Direction& direction : directions()) {
      const bool held = walks && std::any_of(direction.keys.begin(), direction.keys.end(), [&](int key) {
                          return glfwGetKey(window, key) == GLFW_PRESS ||
                                 std::count(pressed.begin(), pressed.end(), key) > 0;
                        });
      if (!held) continue;
      now.motion.*direction.axis += direction.sign;
      moving = true;
    }
    // Slow pictures must not cause leaps, and a key that was only tapped still makes a small step.
    constexpr double tap = 1.0 / 60, leap = 0.25;
    now.seconds = was_moving ? std::min(since_poll.seconds(), leap) : tap;
    since_poll.restart();
    now.leave = glfwWindowShouldClose(window) != 0;
    // In a window that has just opened nothing has told yet.
    if (!cursor_known) glfwGetCursorPos(window, &cursor_x, &cursor_y);
    now.cursor = in_pixels(cursor_x, cursor_y);
    pressed.clear();
    return now;
  }

  void on_key(int key, int action, int modifiers) {
    if (reads_text) return on_text_key(key, action, modifiers);
    const bool moves_on = action == GLFW_REPEAT && (key == GLFW_KEY_PAGE_UP || key == GLFW_KEY_PAGE_DOWN);
    if (action != GLFW_PRESS && !moves_on) return;
    if ((modifiers & GLFW_MOD_CONTROL) != 0) {
      if (const auto command = control_command_of(key, modifiers)) return add(*command);
    }
    pressed.push_back(key);
    if (const auto command = command_of(key, modifiers)) add(*command);
  }

  void on_text_key(int key, int action, int modifiers) {
    if (action == GLFW_RELEASE) return;
    const bool enters = key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER;
    if (enters) {
      input.typed += (modifiers & GLFW_MOD_CONTROL) != 0 ? '\v'
                     : (modifiers & GLFW_MOD_SHIFT) != 0 ? '\r'
                                                         : '\n';
    }
    if (key == GLFW_KEY_BACKSPACE) input.typed += '\b';
    if (key == GLFW_KEY_ESCAPE) add(Command::escape);
    if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12 && action == GLFW_PRESS) {
      if (const auto command = command_of(key, modifiers)) add(*command);
    }
  }

  void on_letter(unsigned code) {
    if (reads_text) return append_letter(input.typed, code);
    if (code == '/') add(Command::search);
  }

  void add(Command command) {
    input.commands.push_back(command);
    if (command == Command::search) reads_text = true;  // what is typed at once, too
    if (command == Command::escape) reads_text = false;
  }

  bool holds(int left, int right) const {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
  }

  void on_wheel(double steps) {
    const bool control = holds(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
               alt = holds(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    (control ? input.motion.faster : alt ? input.section : input.zoom) += steps;
  }

  /// One button at a time: the first that was pressed counts until it is released.
  void on_button(int button, int action, int modifiers) {
    // Later on, the place of the last event: where the cursor is now can be ahead of the events.
    if (!cursor_known) glfwGetCursorPos(window, &cursor_x, &cursor_y);
    cursor_known = true;
    if (action == GLFW_PRESS && button_held < 0) {
      button_held = button;
      dragged = 0;
      if (Drag* drag = dragging()) drag->begins = in_pixels(cursor_x, cursor_y);
      pressed_at = in_pixels(cursor_x, cursor_y);
    } else if (action == GLFW_RELEASE && button == button_held) {
      if (button_held == GLFW_MOUSE_BUTTON_LEFT && dragged < click_pixels) {
        input.clicked = pressed_at;
        input.click_adds = (modifiers & GLFW_MOD_CONTROL) != 0;
        clicked.push_back(std::exchange(input, {}));
      }
      button_held = -1;
      if (glfwGetInputMode(window, GLFW_CURSOR) != GLFW_CURSOR_DISABLED) return;
      glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_NORMAL);
      glfwGetCursorPos(window, &cursor_x, &cursor_y);  // it is where the turn began
    }
  }

  void on_cursor(double x, double y) {
    const double right = x - cursor_x, down = y - cursor_y;
    cursor_x = x;
    cursor_y = y;
    cursor_known = true;
    if (button_held < 0) return;
    const double before = std::exchange(dragged, dragged + std::hypot(right, down));
    if (button_held == GLFW_MOUSE_BUTTON_LEFT) {
      input.motion.turn_right += right;
      input.motion.turn_down += down;
      // From here on the edge of the screen does not end the turn.
      if (before < click_pixels && dragged >= click_pixels)
        glfwSetInputMode(window, GLFW_CURSOR, GLFW_CURSOR_DISABLED);
    } else if (Drag* drag = dragging()) {
      drag->right += right;
      drag->down += down;
    }
  }

  Drag* dragging() {
    if (button_held == GLFW_MOUSE_BUTTON_RIGHT) return &input.orbit;
    return button_held == GLFW_MOUSE_BUTTON_MIDDLE ? &input.pan : nullptr;
  }

  /// Of the window's coordinates, which need not be pixels.
  CursorPlace in_pixels(double x, double y) const {
    int width = 0, height = 0, pixels_wide = 0, pixels_high = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixels_wide, &pixels_high);
    return {x * pixels_wide / std::max(width, 1), y * pixels_high / std::max(height, 1)};
  }

  static Implementation& of(GLFWwindow* window) {
    return *static_cast<Implementation*>(glfwGetWindowUserPointer(window));
  }

  Library library;
  GLFWwindow* window = nullptr;
  std::optional<WindowContext> context;
  std::optional<WindowPicture> picture;   ///< of targets that are not OpenGL's
  std::unique_ptr<SharedPicture> shared;  ///< of them, too, where OpenGL has no graphics card to copy them
  Input input;                            ///< since the last click
  std::deque<Input> clicked;  ///< what ended with a click, not polled yet: each counts before what came later
  std::vector<Rgba> drawn_over;      ///< a picture with lines
  std::optional<WindowLines> lines;  ///< over pictures that are OpenGL's
  bool reads_text = false;
  std::vector<int> pressed;  ///< since the last poll, perhaps released already
  bool moving = false;
  static constexpr double click_pixels = 4;  ///< shorter ways of the mouse are none
  int button_held = -1;                      ///< the button
  double dragged = 0;                        ///< how far
  CursorPlace pressed_at;
  double cursor_x = 0, cursor_y = 0;
  bool cursor_known = false;
  Stopwatch since_poll;
};

Window::Window(const WindowOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
Window::~Window() = default;

Input Window::poll(double patience) { return implementation_->poll(patience); }

std::vector<uint8_t> Window::show(const FrameTarget& target, bool read_back,
                                  std::span<const ScreenLine> lines) {
  if (target.copy_to_window(width(), height())) {
    if (!lines.empty()) {
      if (!implementation_->lines) implementation_->lines.emplace();
      implementation_->lines->draw(lines, target.width(), target.height());
    }
  } else {
    std::span<const uint8_t> colors = target.colors_in_memory();
    if (!lines.empty()) {
      std::vector<Rgba>& drawn = implementation_->drawn_over;
      drawn.resize(colors.size() / sizeof(Rgba));
      std::memcpy(drawn.data(), colors.data(), drawn.size() * sizeof(Rgba));
      draw_lines(lines, target.width(), target.height(), drawn);
      colors = {reinterpret_cast<const uint8_t*>(drawn.data()), colors.size()};
    }
    const bool fits = target.width() == width() && target.height() == height();
    if (fits && implementation_->shared && implementation_->shared->show(colors, width(), height()))
      return read_back ? std::vector<uint8_t>(colors.begin(), colors.end()) : std::vector<uint8_t>();
    std::optional<WindowPicture>& picture = implementation_->picture;
    if (!picture) picture.emplace();
    picture->show(colors, target.width(), target.height(), width(), height());
  }
  std::vector<uint8_t> colors;
  if (read_back) colors = read_window(width(), height());
  glfwSwapBuffers(implementation_->window);
  return colors;
}

void Window::read_text(bool wanted) { implementation_->reads_text = wanted; }

std::string Window::clipboard() const {
  const char* text = glfwGetClipboardString(implementation_->window);
  return text ? text : "";
}

void Window::set_clipboard(const std::string& text) {
  glfwSetClipboardString(implementation_->window, text.c_str());
}

void Window::set_title(const std::string& title) {
  glfwSetWindowTitle(implementation_->window, title.c_str());
}

double Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(implementation_->window, &x, &y);
  return std::max(x, y);
}

int Window::width() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(implementation_->window, &width, &height);
  return std::max(width, 1);
}

int Window::height() const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(implementation_->window, &width, &height);
  return std::max(height, 1);
}

const DeviceNames& Window::names() const { return implementation_->context->names(); }

}  // namespace triptych
