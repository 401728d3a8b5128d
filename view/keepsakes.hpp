// Files that a person asks for on the way: pictures, cameras, walked paths. No failure ends the walk.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace triptych {

/// Writes FOLDER/KIND-000.EXTENSION, or the first number that is free, and says so, or what went wrong.
/// Returns a few words for the title.
std::string keep(const std::filesystem::path& folder, const std::string& kind, const std::string& extension,
                 const std::function<void(const std::filesystem::path&)>& write);

}  // namespace triptych
