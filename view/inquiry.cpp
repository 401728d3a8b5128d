#include "view/inquiry.hpp"

#include "base/notice.hpp"
#include "view/help.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {

/// Whether both are of the same things.
bool same(const std::vector<Selection>& a, const std::vector<Selection>& b) {
  return std::ranges::equal(a, b, same_thing);
}

}  // namespace

Inquiry::Inquiry(const Pack& pack, Tour& tour)
    : pack_(pack), tour_(tour), system_(model_system(pack.read_options())), measuring_(system_) {}

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
    case Command::help:
      if (++help_page_ == 1) say(viewer_help());
      break;
    case Command::escape:
      if (help_page_ > 0) {
        help_page_ = 0;
      } else if (search_) {
        search_.reset();
      } else if (measuring_.active()) {
        measuring_.end();
      } else if (!tour_.selected().empty()) {
        tour_.selected().clear();
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
    const size_t letters = std::min(typed.find_first_of("\b\n\r\v", i), typed.size()) - i;
    if (letters > 0) search_->type(std::string_view(typed).substr(i, letters));
    i += letters;
    if (i == typed.size()) break;
    if (typed[i] == '\b') {
      search_->erase();
    } else if (!search_->found().empty()) {
      select_found(typed[i]);
      if (!tour_.selected().box().empty()) moved = tour_.take(Command::fit, width, height) || moved;
    }
    ++i;
  }
  return moved;
}

void Inquiry::select_found(char key) {
  Selected& selected = tour_.selected();
  if (key == '\v') {
    std::vector<Selection> all;
    for (const SourceObjectId object : search_->found()) all.push_back(tour_.selector().describe(object));
    selected.set(std::move(all));
    say(selected.name() + "\n");
  } else {
    selected.set(tour_.selector().describe(*search_->step(key == '\r')));
    say(selected.all().front().text);
  }
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

bool Inquiry::changed() const { return changed_ || !same(tour_.selected().all(), outlined_); }

std::string Inquiry::title() const { return search_ ? search_->title() : measuring_.title(); }

std::vector<ScreenLine> Inquiry::lines(const FrameState& frame, double content_scale) {
  changed_ = false;
  const Selected& selected = tour_.selected();
  const bool moved = outline_ && !outline_->is_of(pack_.skeleton(), frame);
  if (moved || !same(selected.all(), outlined_)) {
    outlined_ = selected.all();
    outline_.reset();
    if (!selected.empty())
      outline_.emplace(pack_.skeleton(), tour_.picker().chunks(), tour_.selector(), outlined_, frame);
  }
  Overlay overlay(frame.view, content_scale);
  if (outline_) outline_->draw(overlay, frame);
  if (help_page_ > 0) {
    // Two columns in letters that can be read, or one in those that other words have.
    const glm::dvec2 small = overlay.letters(1), usual = overlay.letters(overlay.unit());
    auto pages =
        help_pages(static_cast<size_t>(std::max(small.x, 0.0)), static_cast<size_t>(std::max(small.y, 0.0)));
    if (pages.size() > 1)
      pages = help_pages(static_cast<size_t>(std::max(usual.x, 0.0)),
                         static_cast<size_t>(std::max(usual.y, 0.0)));
    if (help_page_ <= pages.size()) {
      overlay.page(pages[help_page_ - 1]);
      return overlay.lines();
    }
    help_page_ = 0;
  }
  if (search_) overlay.panel(Overlay::Corner::upper_left, search_->words());
  if (!selected.empty())
    overlay.panel(Overlay::Corner::lower_left, {{selected.name(), selection_color}, {selected.sum(system_)}});
  measuring_.draw(overlay);
  return overlay.lines();
}

}  // namespace triptych
