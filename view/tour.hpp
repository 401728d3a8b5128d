// A person's tour of a model: where the eye is, where it was, and what is under the cursor.
#pragma once

#include "base/clock.hpp"
#include "scene/path.hpp"
#include "view/selected.hpp"
#include "view/window.hpp"

#include <array>
#include <vector>

namespace triptych {

class Tour {
 public:
  /// The start is what Command::home goes back to. The pack must outlive it.
  Tour(const Pack& pack, const Walker& start);

  /// The last picture: what is under the cursor is looked up there, and the speed of walking is set by how
  /// far what it shows is away.
  void saw(const FrameState& frame, VisibleSet visible);
  /// Both: whether the eye moved. width, height: of the window, pixels.
  bool take(const Input& input, int width, int height);
  bool take(Command command, int width, int height);
  /// The eye is moved by something else, as when a path is played.
  void jump_to(const Camera& camera) { walker_.jump_to(camera); }
  /// As if the person had been here before; Command::home goes back to the start all the same.
  void begin_at(const Camera& camera, double pace) {
    walker_.jump_to(camera);
    walker_.set_pace(pace);
  }

  const Walker& walker() const { return walker_; }
  /// What was clicked on or searched for.
  const Selected& selected() const { return selected_; }
  Selected& selected() { return selected_; }
  Selector& selector() { return selector_; }
  Picker& picker() { return picker_; }
  /// The last picture, and what it shows; null before the first.
  const FrameState* frame() const { return frame_ ? &*frame_ : nullptr; }
  const VisibleSet& visible() const { return visible_; }
  /// Of what is selected, or else of all that is shown.
  Box subject() const;
  /// What the last picture shows there.
  std::optional<Picked> under(const CursorPlace& place);

 private:
  /// Fits what is selected, or all, into the window, as near to where one looks now as something can be seen
  /// of it; without turning where a side was asked for.
  void fit(double aspect, bool turns);
  /// How far before a box one may stand until something else hides its middle, and each of eight places near
  /// its corners; ascending.
  std::array<double, 9> clear_distances(const Box& box, const glm::dvec3& sight);
  bool is_inside() const;
  /// Where there is only background a place as far away as what was seen last.
  glm::dvec3 point_under(const CursorPlace& place);
  /// Adds what is there to the selection, or takes it away; or selects that alone.
  void select(const CursorPlace& place, bool adds);
  /// Keeps where the eye is, for Command::back, if it stood still there.
  void remember();

  const Pack& pack_;
  Picker picker_;
  Selector selector_;
  Walker walker_, home_;
  std::vector<Walker> before_;
  std::optional<FrameState> frame_;
  VisibleSet visible_;
  glm::dvec3 orbit_at_{0}, pan_at_{0};
  Selected selected_;
  Stopwatch since_move_, since_look_;
  bool looked_ = false;
};

/// The camera as a path has it, whose frustum must be symmetric.
PathFrame path_frame(const Camera& camera);

}  // namespace triptych
