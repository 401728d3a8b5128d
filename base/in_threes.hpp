// Numbers as people read them.
#pragma once

#include <string>
#include <string_view>

namespace triptych {

/// 1204.5 as "1,204.5", with so many decimals; mark: between thousands.
std::string in_threes(double value, int decimals = 0, std::string_view mark = ",");

}  // namespace triptych
