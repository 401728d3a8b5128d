// X3D as Assimp 5.2 can read it.
#pragma once

#include <string>

namespace triptych {

/// Without the quotes around the strings of attributes that are lists of them, as in url='"wood.png"': where
/// a list has one string, Assimp takes its quotes for damage and gives the file up. What those lists say
/// (images, metadata) is not drawn.
std::string without_quotes_in_lists(const std::string& x3d);

}  // namespace triptych
