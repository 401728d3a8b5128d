// What a person asks of the model in a window beside a click: to measure it, to search in it; and what is
// selected, as lines.
#pragma once

#include "view/measuring.hpp"
#include "view/outline.hpp"
#include "view/search.hpp"
#include "view/tour.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

class Inquiry {
 public:
  /// Both must outlive it.
  Inquiry(const Pack& pack, Tour& tour);

  /// Takes out of the input what it answers. width, height: of the window, pixels. True where the eye moved.
  bool take(Input& input, int width, int height);
  /// Another picture was drawn: something else may be under the cursor.
  void saw();
  /// Whether there is something else to draw over the picture than lines() gave.
  bool changed() const;
  /// Whether letters are words, not commands.
  bool reads_text() const { return search_.has_value(); }
  /// A few words for a title; empty where there is nothing to say.
  std::string title() const;
  /// What to draw over the view's picture. content_scale: as Overlay has it.
  std::vector<ScreenLine> lines(const FrameState& frame, double content_scale = 1);

  const Measuring& measuring() const { return measuring_; }
  Measuring& measuring() { return measuring_; }

 private:
  /// Whether the command was answered.
  bool take(Command command);
  bool read(const std::string& typed, int width, int height);
  /// Selects the next object that the search finds, or the one before, or all.
  void select_found(char key);
  void hover();

  const Pack& pack_;
  Tour& tour_;
  const ModelSystem system_;
  Measuring measuring_;
  std::optional<Search> search_;
  std::optional<SelectionOutline> outline_;
  std::vector<Selection> outlined_;  ///< what that is of
  CursorPlace cursor_;
  bool changed_ = false;
  size_t help_page_ = 0;  ///< that is shown, counted from 1; 0: none
};

}  // namespace triptych
