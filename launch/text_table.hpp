// Small tables on the terminal.
#pragma once

#include "base/in_threes.hpp"

#include <string>
#include <vector>

namespace triptych {

/// One line per row, the head first; columns right-aligned under their names, the first one left-aligned.
/// Every row has as many cells as the head.
std::string text_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows);

}  // namespace triptych
