// Whole inputs for the fuzz targets of the network's bytes.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace triptych::fuzz {

/// Name ("message/0") and bytes of each.
std::vector<std::pair<std::string, std::vector<std::byte>>> wire_seeds();

}  // namespace triptych::fuzz
