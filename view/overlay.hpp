// What is drawn over a picture for a person: lines in the model, marks and words beside them.
#pragma once

#include "view/near_cursor.hpp"
#include "visibility/screen_lines.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

inline constexpr glm::vec4 measure_color(1, 0.85f, 0.1f, 1), snap_color(0.2f, 1, 0.4f, 1),
    selection_color(1, 0.45f, 0.05f, 1), word_color(1, 1, 1, 1);

/// Of one view. Everything but thin lines has a dark rim, so that it shows on any ground.
class Overlay {
 public:
  explicit Overlay(const View& view);

  /// Between places of model space; what lies before the near plane is cut off.
  void line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  /// The same without a rim, for many.
  void thin_line(const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& color);
  void box(const Box& box, const glm::vec4& color);

  /// Marks at a place of model space: nothing where that is before the near plane.
  void square(const glm::dvec3& at, const glm::vec4& color);
  void cross(const glm::dvec3& at, const glm::vec4& color);
  void diamond(const glm::dvec3& at, const glm::vec4& color);
  /// One line of words to the right of a place of model space, so many lines below it.
  void words(const glm::dvec3& at, std::string_view text, const glm::vec4& color, int lines_below = 0);
  /// One line of words from the picture's upper left on, the first of which is line 0.
  void banner(std::string_view text, const glm::vec4& color, int line = 0);

  /// In the order in which they are to be drawn.
  std::vector<ScreenLine> lines() const;

 private:
  std::optional<glm::dvec2> pixel(const glm::dvec3& at) const;
  /// Pixels from left and top.
  void stroke(const glm::dvec2& from, const glm::dvec2& to, const glm::vec4& color);
  void put_words(const glm::dvec2& at, std::string_view text, const glm::vec4& color);
  void mark(const glm::dvec3& at, std::span<const glm::dvec2> corners, const glm::vec4& color);
  void rim(const ScreenLine& line);

  PictureSpace space_;
  double unit_;  ///< of marks and letters, pixels
  ScreenLines thin_, solid_;
  std::vector<ScreenLine> rims_, strokes_;
};

}  // namespace triptych
