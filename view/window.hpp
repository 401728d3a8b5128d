// A window with OpenGL 4.5 in it, and what a person does there (GLFW).
#pragma once

#include "render/context.hpp"
#include "view/navigation.hpp"
#include "visibility/frame_target.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

struct WindowOptions {
  std::string title;
  int width = 512, height = 512;
  /// Where the window's OpenGL comes from; empty: the display's own (GLX).
  std::optional<ContextKind> context;
};

/// What pressing a key once does.
enum class Command {
  toggle_culling,
  toggle_birds_eye,
  toggle_play,
  toggle_motion,
  toggle_edges,
  begin_section,  ///< a plane in the surface under the cursor
  flip_section,   ///< of section planes: the last one
  delete_section,
  push_section,
  pull_section,
  toggle_section_box,
  take_picture,
  finer,
  coarser,
  slower,
  faster,
  home,
  back,
  fit,  ///< all of what is selected, or of the model, into the window
  look_at_front,
  look_at_right,
  look_at_top,
  switch_projection,
  save_camera,
  record_walk,
  hide_object,  ///< what is selected, with all that is in it
  hide_layer,   ///< all of its layer
  hide_storey,
  hide_file,
  isolate_object,  ///< hides all the rest
  isolate_layer,
  isolate_storey,
  isolate_file,
  show_all,
  undo,  ///< what was hidden, shown or cut last
  redo,
  save_viewpoint,
  copy_camera,
  paste_camera,
  measure,
  search,  ///< from here on keys are text, until Window::read_text(false)
  escape,
  help
};

/// A place in the window: pixels from its left and top.
struct CursorPlace {
  double x = 0, y = 0;
};

/// The mouse moved with a button held.
struct Drag {
  std::optional<CursorPlace> begins;  ///< where the button was pressed, since the last time
  double right = 0, down = 0;         ///< pixels
};

/// What happened since the last time.
struct Input {
  WalkerMotion motion;
  double seconds = 0;  ///< how long the motion's directions were held
  Drag orbit, pan;
  double zoom = 0;                     ///< steps of the wheel, away from the person
  double section = 0;                  ///< the same with Alt held
  CursorPlace cursor;                  ///< where it is now
  std::optional<CursorPlace> clicked;  ///< the left button, without a move
  bool click_adds = false;             ///< with Ctrl or Shift held
  std::vector<Command> commands;       ///< in the order of their keys
  /// Letters, UTF-8, while keys are text; backspace is \b, enter \n, with shift \r, with Ctrl
  /// \v.
  std::string typed;
  bool leave = false;  ///< the window was closed
  bool resized = false, damaged = false;
};

/// One window, its context current in this thread. Error (place: window) where there is no display, or
/// nothing on it that offers OpenGL 4.5.
class Window {
 public:
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  /// Reads input. patience: how many seconds to wait for some if there is none; ignored while a direction is
  /// held.
  Input poll(double patience);
  /// Copies the target's colours into the window, with lines over them, which the target has not; returns
  /// RGBA of what it then shows, bottom row first, if `read_back`.
  std::vector<uint8_t> show(const FrameTarget& target, bool read_back = false,
                            std::span<const ScreenLine> lines = {});
  /// Whether keys are letters of a text, not commands.
  void read_text(bool wanted);
  /// The text that was copied last, in whatever program; empty where there is none.
  std::string clipboard() const;
  void set_clipboard(const std::string& text);
  void set_title(const std::string& title);
  /// How much larger than usual the display wants words.
  double content_scale() const;
  int width() const;  ///< in pixels; at least 1
  int height() const;
  const DeviceNames& names() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace triptych
