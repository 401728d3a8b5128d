// Interactive viewing: turns input in the window into frames to draw, and shows them.
#pragma once

#include "lod/frame_rules.hpp"
#include "lod/hierarchy.hpp"
#include "nodes/frame_record.hpp"
#include "scene/frame_state.hpp"
#include "scene/pack.hpp"
#include "scene/path.hpp"
#include "view/birds_eye.hpp"
#include "view/edits.hpp"
#include "view/help.hpp"
#include "view/inquiry.hpp"
#include "view/last_place.hpp"
#include "view/motion_clock.hpp"
#include "view/passing_words.hpp"
#include "view/window.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct ViewerOptions {
  WindowOptions window;
  std::optional<Path> path;  ///< to start from and to play; without one the view shows the model's box
  bool play = false;         ///< starts playing at once
  double rate = 0;           ///< the path's cameras a second; 0: as fast as pictures come
  double pixel_error = 1;
  uint32_t samples = 1;  ///< a pixel
  bool edges = false;    ///< drawn as lines
  Effects effects = Effects::all();
  double time = 0;  ///< seconds, of what moves, at the beginning
  Sky sky = {};
  Hiding hiding = {};  ///< at the beginning
  bool culling = true;
  std::filesystem::path pictures = ".";    ///< where F2 to F5 save files; if they can: no key ends a walk
  Section section = {};                    ///< what is cut away
  std::vector<std::string> selected = {};  ///< GUIDs: those that the model has are selected
  /// Where a person stands is kept in this file, and a viewer that finds it begins there; none where empty.
  std::filesystem::path place = {};
};

class Viewer {
 public:
  Viewer(const Pack& pack, ViewerOptions options);
  /// Saves the walk that is still being recorded.
  ~Viewer();

  /// Waits, at most so many seconds, until there is something new to draw: movement, a key, another size, the
  /// path's next camera.
  bool wait_for_frame(double patience);
  /// Whether the window was closed, or a signal asked to end.
  bool left() const { return left_; }

  /// The frame to draw now; each call gives the next number.
  FrameRequest next_frame();
  bool culling() const { return options_.culling; }
  const Hiding& hiding() const { return edits_.hiding(); }

  /// Shows a frame that was drawn: its picture or, if the person wants that, the bird's-eye view of it.
  /// device: any of this pack in the window's context. The picture must stay as it is until the next frame
  /// is drawn: it is shown again where only what is drawn over it changes.
  void show(const FrameRequest& frame, const FrameRecord& record, const FrameTarget& picture, Device& device);

  /// Why pictures are drawn without the help of other processes, for the title; empty where they help.
  void say_alone(const std::string& reason);

  Window& window() { return window_; }
  const DeviceNames& names() const { return window_.names(); }

 private:
  void take(Input input);
  void take(Command command);
  View view() const;
  /// Whether the path's next camera is due.
  bool plays() const;
  /// Whether the next frame differs from the one before, though nobody asked for anything.
  bool goes_on() const {
    constexpr double least = 1.0 / 60;  // seconds: more pictures than that nobody sees
    return plays() || (clock_.runs() && since_frame_.seconds() >= least);
  }
  void save(Command command);
  void take_camera(const std::string& text);
  /// The camera as the person sees through it.
  PathFrame camera() const;
  void select_first(const std::vector<std::string>& guids);
  void select_again(const LastPlace& place, const View& view);
  void save_viewpoint(const std::vector<uint8_t>& colors, const FrameState& frame);
  void begin_at(const LastPlace& place);
  void keep_place();
  /// What is drawn over the picture has changed.
  void show_again();
  void set_title();
  /// What of a frame is cut open and has no cut surface, for the title; empty where nothing is.
  std::string open_words(const FrameState& frame, const VisibleSet& visible) const;

  const Pack& pack_;
  const double near_;  ///< the near plane where the path names none
  ViewerOptions options_;
  Window window_;
  Tour tour_;
  size_t path_frame_ = 0;  ///< the one to show next
  uint32_t next_number_ = 0;
  bool new_frame_ = true;  ///< whether the window has to be drawn again
  bool left_ = false, birds_eye_wanted_ = false, picture_wanted_ = false, viewpoint_wanted_ = false;
  std::optional<BirdsEye> birds_eye_;
  std::optional<PathFrame> exact_;  ///< the path's camera, until the person moves away from it
  std::optional<Path> walk_;        ///< what is being recorded
  PassingWords said_;               ///< for the title
  Inquiry inquiry_;
  Edits edits_;
  const FrameTarget* shown_ = nullptr;  ///< what is in the window; null before the first picture
  std::string figures_;                 ///< of the last frame, for the title
  std::string open_;                    ///< open_words() of it
  Hierarchy hierarchy_;
  MotionClock clock_;
  std::string alone_;  ///< why, for the title
  PlaceKeeper place_;
  Stopwatch since_path_frame_, since_frame_;
};

}  // namespace triptych
