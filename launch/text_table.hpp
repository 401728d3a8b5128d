// Small tables on the terminal.
#pragma once

#include <string>
#include <vector>

namespace triptych {

/// "12,345": digits in threes, decimals after the point.
std::string in_threes(double value, int decimals = 0);

/// One line per row, the head first; columns right-aligned under their names, the first one left-aligned.
/// Every row has as many cells as the head.
std::string text_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows);

}  // namespace triptych
