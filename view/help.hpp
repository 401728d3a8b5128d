// What keys and mouse do in the window, in words.
#pragma once

#include "view/overlay.hpp"

#include <string>
#include <vector>

namespace triptych {

/// For a terminal: some twenty-five lines, two columns.
std::string viewer_help();
/// The same for the window.
std::vector<Words> help_words();

}  // namespace triptych
