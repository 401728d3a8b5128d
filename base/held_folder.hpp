// Folders that a process holds while it lives: what killed ones leave can be told from what is in use.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>
#include <functional>
#include <string>

namespace triptych {

/// Locks the folder for this process and no program that it starts. Not open, with errno, where it cannot be
/// opened, another process holds it, or the name does not stand for a folder of this user's any more. Where
/// the file system has no locks it is open all the same: there nobody removes anything either.
Descriptor hold_folder(const std::filesystem::path& folder);

/// Removes the folders in `parent` that have such a name and that nobody holds, with all that is in them.
/// What fails does no harm.
void remove_forsaken_folders(const std::filesystem::path& parent,
                             const std::function<bool(const std::string& name)>& is_such);

}  // namespace triptych
