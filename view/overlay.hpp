// What is drawn over a picture for a person: lines in the model, marks, and words beside them.
#pragma once

#include "view/label_layout.hpp"
#include "view/near_cursor.hpp"
#include "visibility/screen_lines.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

inline constexpr glm::vec4 measure_color(1, 0.85f, 0.1f, 1), snap_color(0.2f, 1, 0.4f, 1),
    selection_color(1, 0.45f, 0.05f, 1), word_color(1, 1, 1, 1);

/// One line of words.
struct Words {
  std::string text;
  glm::vec4 color = word_color;
};

/// Of one view. Lines and marks have a dark rim, and words a dark ground, so that they show on anything; both
/// are larger in larger pictures. Words are moved so that they hide neither others nor marks and lines.
class Overlay {
 public:
  /// content_scale: how much larger than usual the display wants words.
  explicit Overlay(const View& view, double content_scale = 1);

  /// Between places of model space; what lies before the near plane is cut off.
  void line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  /// The same without a rim, for many.
  void thin_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  void box(const Box& box, const glm::vec4& color);

  /// Marks at a place of model space: nothing where that is before the near plane.
  void square(const glm::dvec3& at, const glm::vec4& color);
  void cross(const glm::dvec3& at, const glm::vec4& color);
  void diamond(const glm::dvec3& at, const glm::vec4& color);
  /// Lines of words beside a place of model space; nothing where that is not in the picture. If they had to
  /// be moved away from it, a line leads there.
  void label(const glm::dvec3& at, std::vector<Words> words);

  /// Lines of words in a corner of the picture: those that are there keep clear of the labels. What is longer
  /// than the picture is wide ends with "...", and lines for which other panels leave no room are left out.
  enum class Corner { upper_left, lower_left };
  void panel(Corner corner, const std::vector<Words>& words);
  /// One in the upper left, in letters that are small enough for the whole of it, but not too small to be
  /// read.
  void page(std::vector<Words> words);
  /// How many letters fit beside each other, and above each other, in a page of that unit.
  glm::dvec2 letters(double unit) const;

  /// In the order in which they are to be drawn.
  std::vector<ScreenLine> lines() const;
  /// Of marks and letters: pixels for a unit of stroke_font.hpp.
  double unit() const { return unit_; }
  /// Of lines: pixels, 1 in a window 1,080 pixels high.
  int line_width() const { return width_; }
  /// Where labels would stand, in the order in which they were given; for tests.
  std::vector<ScreenBox> label_places() const;

 private:
  struct Label {
    glm::dvec2 anchor;
    std::vector<Words> words;
  };
  std::optional<glm::dvec2> pixel(const glm::dvec3& at) const;
  ScreenLine flat_line(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color) const;
  /// Pixels from left and top.
  void stroke(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color);
  void mark(const glm::dvec3& at, std::span<const glm::dvec2> corners, const glm::vec4& color);
  void rim(const ScreenLine& line);
  /// By so many pixels.
  ScreenLine moved(const ScreenLine& line, int right, int up) const;
  void add_wide(std::span<const ScreenLine> lines, std::vector<ScreenLine>& all) const;
  /// Labels do not stand there.
  void keep_clear(const glm::dvec2& pixel);
  /// How large words are, with the ground around them, pixels.
  glm::dvec2 size_of(const std::vector<Words>& words, double unit) const;
  void write(const ScreenBox& box, const std::vector<Words>& words, double unit,
             std::vector<ScreenLine>& lines) const;

  PictureSpace space_;
  glm::dvec2 picture_;
  double unit_;
  int width_;
  ScreenLines thin_, solid_;
  std::vector<ScreenLine> rims_, strokes_, panel_lines_;
  std::vector<Label> labels_;
  std::vector<ScreenBox> panels_;
  std::vector<ScreenBox> shown_;  ///< marks and lines, about
};

}  // namespace triptych
