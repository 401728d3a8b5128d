#include "view/inquiry.hpp"

#include "base/notice.hpp"
#include "scene/hidden_objects.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {

/// Whether the object is hidden: then its outline would be around nothing.
bool is_hidden(const FrameState& frame, SourceObjectId object) {
  const HiddenObjects* const hidden = frame.hiding.objects.get();
  return hidden && std::ranges::binary_search(hidden->objects(), object);
}

/// Whether both are of the same thing.
bool same(const std::optional<Selection>& a, const std::optional<Selection>& b) {
  if (a.has_value() != b.has_value()) return false;
  if (!a) return true;
  const auto place = [](const Selection& s) {
    return s.picked ? std::pair(s.picked->drawable, s.picked->placement) : std::pair(no_id, 0u);
  };
  return a->object == b->object && (a->object != no_id || place(*a) == place(*b));
}

}  // namespace

Inquiry::Inquiry(const Pack& pack, Tour& tour)
    : pack_(pack), tour_(tour), measuring_(model_system(pack.read_options())) {}

bool Inquiry::take(Input& input, int width, int height) {
  const bool moved = read(std::exchange(input.typed, {}), width, height);
  std::erase_if(input.commands, [&](Command command) { return take(command); });
  const bool elsewhere = input.cursor.x != cursor_.x || input.cursor.y != cursor_.y;
  cursor_ = input.cursor;
  if (!measuring_.active()) return moved;
  if (input.clicked) {
    cursor_ = *std::exchange(input.clicked, std::nullopt);
    hover();
    if (const FrameState* frame = tour_.frame()) say(measuring_.click(frame->view, {cursor_.x, cursor_.y}));
    changed_ = true;
  } else if (elsewhere) {
    hover();
  }
  return moved;
}

bool Inquiry::take(Command command) {
  switch (command) {
    case Command::measure:
      measuring_.begin();
      hover();
      break;
    case Command::search:
      if (!search_) search_.emplace(tour_.selector().objects());
      break;
    case Command::back:
      if (!measuring_.active()) return false;
      measuring_.take_back();
      break;
    case Command::escape:
      if (search_) {
        search_.reset();
      } else if (measuring_.active()) {
        measuring_.end();
      } else if (tour_.selection()) {
        tour_.select(std::nullopt);
      } else {
        return false;
      }
      break;
    default:
      return false;
  }
  changed_ = true;
  return true;
}

bool Inquiry::read(const std::string& typed, int width, int height) {
  if (!search_) return false;
  bool moved = false;
  for (size_t i = 0; i < typed.size();) {
    changed_ = true;
    const size_t letters = std::min(typed.find_first_of("\b\n\r", i), typed.size()) - i;
    if (letters > 0) search_->type(std::string_view(typed).substr(i, letters));
    i += letters;
    if (i == typed.size()) break;
    if (typed[i] == '\b') {
      search_->erase();
    } else if (const auto object = search_->step(typed[i] == '\r')) {
      tour_.select(tour_.selector().describe(*object));
      say(tour_.selection()->text);
      if (!tour_.selection()->box.empty()) moved = tour_.take(Command::fit, width, height) || moved;
    }
    ++i;
  }
  return moved;
}

void Inquiry::hover() {
  const FrameState* frame = tour_.frame();
  if (!frame) return;
  const NearCursor near(pack_.skeleton(), tour_.picker().chunks(), *frame, tour_.visible(),
                        {cursor_.x, cursor_.y}, snap_pixels);
  changed_ = measuring_.hover(snap(near)) || changed_;
}

void Inquiry::saw() {
  if (measuring_.active()) hover();
}

bool Inquiry::changed() const { return changed_ || !same(tour_.selection(), outlined_); }

std::string Inquiry::title() const { return search_ ? search_->title() : measuring_.title(); }

std::vector<ScreenLine> Inquiry::lines(const FrameState& frame) {
  changed_ = false;
  if (!same(tour_.selection(), outlined_)) {
    outlined_ = tour_.selection();
    outline_.reset();
    if (outlined_) outline_.emplace(pack_.skeleton(), tour_.picker().chunks(), tour_.selector(), *outlined_);
  }
  Overlay overlay(frame.view);
  if (outline_ && !is_hidden(frame, outlined_->object)) outline_->draw(overlay, frame.view);
  measuring_.draw(overlay);
  if (search_) search_->draw(overlay);
  return overlay.lines();
}

}  // namespace triptych
