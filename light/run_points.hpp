// Where light is gathered: on this process' threads, or in units of a build, so that it can be resumed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace triptych {

/// Values of some floats each for `count` items, item after item. what: for progress.
/// of_item(item, values): appends them; safe on several threads.
using PointValues = std::function<void(uint32_t item, std::vector<float>& values)>;
using RunPoints =
    std::function<std::vector<float>(const std::string& what, uint32_t count, const PointValues& of_item)>;

/// On this process' threads alone.
std::vector<float> run_points(const std::string& what, uint32_t count, const PointValues& of_item);

}  // namespace triptych
