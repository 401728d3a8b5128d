// Folders that samples are written into.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace triptych {

/// Error (file) where the folder has a file of one of these names (shell patterns) and its scene is not one
/// that a sample wrote: --force, which is named, would overwrite it.
void check_holds_only_samples(const std::filesystem::path& folder, const std::vector<std::string>& names);

}  // namespace triptych
