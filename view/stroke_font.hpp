// Letters as strokes, for lines that devices draw over pictures.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace triptych {

/// A cell is so wide and high, in units of the strokes' grid; letters stand on the line at font_base.
inline constexpr double font_advance = 6, font_height = 10, font_base = 2;

/// From one place to another in the text's cell: to the right from its beginning, and upwards from below.
using Stroke = std::pair<glm::dvec2, glm::dvec2>;

/// One line of UTF-8. What the font has not (it has ASCII, °, ², − and the letters of German) is a box.
std::vector<Stroke> strokes_of(std::string_view text);
/// How wide that is, in the same units.
double text_width(std::string_view text);

}  // namespace triptych
