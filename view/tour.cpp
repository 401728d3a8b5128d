#include "view/tour.hpp"

#include "base/notice.hpp"
#include "scene/finest_boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace triptych {

namespace {
constexpr size_t most_remembered = 100;
constexpr double stood_still_s = 1, look_every_s = 0.2;
}  // namespace

Tour::Tour(const Pack& pack, const Walker& start)
    : pack_(pack), picker_(pack), selector_(pack), walker_(start), home_(start) {}

void Tour::saw(const FrameState& frame, VisibleSet visible) {
  frame_ = frame;
  visible_ = std::move(visible);
  if (looked_ && since_look_.seconds() < look_every_s) return;
  looked_ = true;
  since_look_.restart();
  std::vector<double> distances;
  constexpr double places[][2] = {{0.5, 0.5}, {0.25, 0.25}, {0.75, 0.25}, {0.25, 0.75}, {0.75, 0.75}};
  for (const auto& [x, y] : places) {
    if (const auto picked = under({x * frame.view.width, y * frame.view.height}))
      distances.push_back(glm::distance(picked->point, frame.view.camera.eye));
  }
  if (distances.empty()) return;
  std::nth_element(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2),
                   distances.end());
  walker_.see(distances[distances.size() / 2]);
}

std::optional<Picked> Tour::under(const CursorPlace& place) {
  if (!frame_) return std::nullopt;
  return picker_.at(*frame_, visible_, place.x, place.y);
}

glm::dvec3 Tour::point_under(const CursorPlace& place) {
  if (const auto picked = under(place)) return picked->point;
  if (!frame_) return walker_.eye() + walker_.seen() * walker_.direction();
  return Picker::place_at(frame_->view, place.x, place.y, walker_.seen());
}

void Tour::remember() {
  if (before_.empty() || since_move_.seconds() > stood_still_s) before_.push_back(walker_);
  if (before_.size() > most_remembered) before_.erase(before_.begin());
  since_move_.restart();
}

bool Tour::take(const Input& input, int width, int height) {
  bool moved = false;
  for (const Command command : input.commands) moved = take(command, width, height) || moved;
  if (input.clicked) select(*input.clicked, input.click_adds);
  const auto began = [&](const Drag& drag, glm::dvec3& at) {
    if (drag.begins) at = point_under(*drag.begins);
    return drag.right != 0 || drag.down != 0;
  };
  const bool orbits = began(input.orbit, orbit_at_), pans = began(input.pan, pan_at_);
  if (!(input.motion == WalkerMotion{}) || orbits || pans || input.zoom != 0) {
    remember();
    moved = true;
  }
  walker_.move(input.motion, input.seconds, height);
  if (orbits) walker_.orbit(orbit_at_, input.orbit.right, input.orbit.down, height);
  if (pans) walker_.pan(pan_at_, input.pan.right, input.pan.down, height);
  if (input.zoom != 0) walker_.zoom(point_under(input.cursor), input.zoom);
  return moved;
}

Box Tour::subject() const {
  if (const Box box = selected_.box(); !box.empty()) return box;
  const Skeleton& skeleton = pack_.skeleton();
  const Box shown = model_box(skeleton, frame_ ? frame_->hiding.objects.get() : nullptr);
  return shown.empty() ? model_box(skeleton) : shown;
}

bool Tour::is_inside() const {
  const glm::dvec3& eye = walker_.eye();
  return model_box(pack_.skeleton()).contains({eye, eye});
}

std::array<double, 9> Tour::clear_distances(const Box& box, const glm::dvec3& sight) {
  constexpr double infinite = std::numeric_limits<double>::infinity(), share = 0.8;
  const glm::dvec3 centre = center(box), half = box.hi - centre, back = -sight;
  std::array<double, 9> clear{};
  for (size_t i = 0; i < clear.size(); ++i) {
    const glm::dvec3 from = i == 8 ? centre : centre + share * (box.corner(static_cast<int>(i)) - centre);
    // What touches it, as the floor that it stands on, is passed.
    double leaves = infinite;
    for (int axis = 0; axis < 3; ++axis) {
      if (back[axis] == 0) continue;
      leaves = std::min(leaves, ((back[axis] > 0 ? box.hi : box.lo)[axis] - from[axis]) / back[axis]);
    }
    const auto hit =
        picker_.along(*frame_, from, back, leaves * (1 + 1e-6) + pack_.skeleton().lattice().step);
    clear[i] = hit ? glm::dot(hit->point - centre, back) - glm::dot(half, glm::abs(back)) : infinite;
  }
  std::ranges::sort(clear);
  return clear;
}

void Tour::fit(double aspect, bool turns) {
  const Box box = subject();
  const Walker from_here = walker_;
  walker_.frame(box, aspect);
  if (selected_.box().empty() || !frame_) return;
  const glm::dvec3 half = box.hi - center(box);
  constexpr double before_walls = 0.95, least_seen = 0.2, least_apart = 0.01, a_degree_costs = 1.0 / 600;
  constexpr double radians = std::numbers::pi / 180;
  double best = least_seen;  // what is seen of it, less what the turn costs
  for (const int down : {0, 30, 60}) {
    for (const int heading : {0, 30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180}) {
      const double cost = (std::abs(heading) + down) * a_degree_costs;
      if (1 - cost <= best) continue;
      Walker there = from_here;
      there.turn(heading * radians, -down * radians);
      there.frame(box, aspect);
      const double front = glm::dot(half, glm::abs(there.direction()));
      const double all = glm::distance(there.eye(), center(box)) - front;  // where all of it fits in
      const auto clear = clear_distances(box, there.direction());
      for (size_t hidden = 0; hidden < clear.size(); ++hidden) {
        // The further away, the more of it fits in, and the more may stand before it. An orthographic picture
        // is as large from everywhere.
        const double apart = std::min(before_walls * clear[hidden], all);
        const bool fits = there.orthographic() && apart > least_apart * glm::length(half);
        const double points = static_cast<double>(clear.size() - hidden) / clear.size();
        const double seen = points * (there.orthographic() ? fits : apart / all) - cost;
        if (seen <= best) continue;
        best = seen;
        walker_ = there;
        walker_.frame(box, aspect, front + apart);
      }
      // An orthographic picture begins where the eye is, so that walls behind that hide nothing.
      if (!turns || there.orthographic()) return;
    }
  }
}

bool Tour::take(Command command, int width, int height) {
  const Walker was = walker_;
  const double aspect = static_cast<double>(width) / height;
  const auto look_at = [&](Side side) {
    walker_.look_at(side);
    fit(aspect, false);
  };
  switch (command) {
    case Command::home:
      walker_ = home_;
      break;
    case Command::back:
      if (before_.empty()) return false;
      walker_ = before_.back();
      before_.pop_back();
      return true;
    case Command::fit:
      fit(aspect, true);
      break;
    case Command::look_at_front:
      look_at(Side::front);
      break;
    case Command::look_at_right:
      look_at(Side::right);
      break;
    case Command::look_at_top:
      look_at(Side::top);
      break;
    case Command::switch_projection:
      walker_.switch_projection(point_under({width / 2.0, height / 2.0}), is_inside());
      break;
    case Command::slower:
    case Command::faster:
      walker_.move({.faster = command == Command::faster ? 1.0 : -1.0}, 0, height);
      return false;
    default:
      return false;
  }
  before_.push_back(was);
  since_move_.restart();
  return true;
}

void Tour::select(const CursorPlace& place, bool adds) {
  const auto picked = under(place);
  if (!picked) {
    if (!adds) selected_.clear();
    return;
  }
  Selection selection = selector_.describe(*picked, *frame_);
  say(selection.text);
  if (adds) {
    selected_.toggle(std::move(selection));
  } else {
    selected_.set(std::move(selection));
  }
}

PathFrame path_frame(const Camera& camera) {
  PathFrame frame{.eye = camera.eye, .target = camera.target, .up = camera.up};
  if (camera.orthographic()) {
    frame.orthographic_height = camera.top - camera.bottom;
  } else {
    frame.fov_y_degrees = 2 * std::atan(camera.top) * 180 / std::numbers::pi;
  }
  frame.near = camera.near;
  return frame;
}

}  // namespace triptych
