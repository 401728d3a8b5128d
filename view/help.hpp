// What keys and mouse do in the window, in words.
#pragma once

#include "view/overlay.hpp"

#include <string>
#include <vector>

namespace triptych {

/// For a terminal: some twenty-five lines, two columns.
std::string viewer_help();
/// The same for the window, where so many letters fit beside and above each other: on one page, or else in
/// one column on several.
std::vector<std::vector<Words>> help_pages(size_t columns, size_t lines);

}  // namespace triptych
