// Sections in words, as command lines have them.
#pragma once

#include "scene/section.hpp"

#include <string>
#include <string_view>

namespace triptych {

/// "NX,NY,NZ,D" keeps the points p with dot((NX, NY, NZ), p) ≥ D; "x<12.5", "z > 3" and the like keep what
/// they say. Error (place) for any other words.
SectionPlane read_section_plane(std::string_view words, const std::string& place);
/// "X0,Y0,Z0,X1,Y1,Z1". Error (place) for any other words.
Box read_section_box(std::string_view words, const std::string& place);

/// What the two above read back, to the bit.
std::string section_words(const SectionPlane& plane);
std::string section_words(const Box& box);

}  // namespace triptych
