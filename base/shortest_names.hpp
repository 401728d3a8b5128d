// What to call files in reports: as little of their paths as tells them apart.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// For each file the last parts of its path, as many as no other file has; the whole path, without links and
/// dots in its folder, of a file that is named twice.
std::vector<std::string> shortest_names(std::span<const std::filesystem::path> files);

}  // namespace triptych
