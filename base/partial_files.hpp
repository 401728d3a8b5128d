// Files under construction: named after their process, locked by it, and removed once it is gone.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace triptych {

/// "PATH.partial-PID", of this process.
std::filesystem::path partial_name(const std::filesystem::path& path);

/// What it is to become, of such a name without folder; empty for another name.
std::string_view name_of_partial(std::string_view name);

/// Opens the empty file of that name for writing. Other processes see that it is under construction for as
/// long as it is open. Null, with errno, where it cannot be opened.
std::FILE* open_partial_file(const std::filesystem::path& partial);

/// Removes what processes that are gone left in the folder under such names: this user's regular files that
/// nobody holds. What fails does no harm.
void remove_forsaken_partial_files(const std::filesystem::path& folder);

/// The same, at the first call for each folder.
void remove_forsaken_partial_files_once(const std::filesystem::path& folder);

}  // namespace triptych
