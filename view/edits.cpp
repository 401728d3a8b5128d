#include "view/edits.hpp"

#include <utility>

namespace triptych {

namespace {
constexpr double moment_s = 1;
}  // namespace

void SightHistory::change(const Sight& was, bool goes_on) {
  const bool same_step = goes_on && goes_on_ && !before_.empty() && since_change_.seconds() < moment_s;
  goes_on_ = goes_on;
  since_change_.restart();
  after_.clear();
  if (same_step) return;
  before_.push_back(was);
  if (before_.size() > most_steps) before_.erase(before_.begin());
}

std::optional<Sight> SightHistory::undo(const Sight& now) {
  if (before_.empty()) return std::nullopt;
  goes_on_ = false;
  after_.push_back(now);
  Sight then = std::move(before_.back());
  before_.pop_back();
  return then;
}

std::optional<Sight> SightHistory::redo(const Sight& now) {
  if (after_.empty()) return std::nullopt;
  goes_on_ = false;
  before_.push_back(now);
  Sight then = std::move(after_.back());
  after_.pop_back();
  return then;
}

bool Edits::takes(Command command) {
  return Hider::takes(command) || Sections::takes(command) || command == Command::undo ||
         command == Command::redo;
}

std::string Edits::take(Command command, Tour& tour, const CursorPlace& cursor) {
  if (command == Command::undo || command == Command::redo) {
    const bool back = command == Command::undo;
    auto then = back ? history_.undo(sight()) : history_.redo(sight());
    if (!then) return back ? "nothing to undo" : "nothing to redo";
    begin_at(std::move(then->hiding), then->section);
    return {};
  }
  const Sight was = sight();
  std::string words;
  if (Hider::takes(command)) {
    words = hider_.take(command, tour.selector().objects(), tour.selected().objects());
  } else {
    Sections::Scene scene{.eye = tour.walker().eye(),
                          .under_cursor = std::nullopt,
                          .box = tour.subject(),
                          .is_selected = !tour.selected().box().empty()};
    if (command == Command::begin_section) scene.under_cursor = tour.under(cursor);
    words = sections_.take(command, scene);
  }
  if (!(sight() == was))
    history_.change(was, command == Command::push_section || command == Command::pull_section);
  return words;
}

void Edits::move(double steps, const glm::dvec3& eye) {
  const Sight was = sight();
  sections_.move(steps, eye);
  if (!(sight() == was)) history_.change(was, true);
}

void Edits::begin_at(Hiding hiding, const Section& section) {
  hider_.begin_at(std::move(hiding));
  sections_.begin_at(section);
}

}  // namespace triptych
