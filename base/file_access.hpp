// Checks which files can be read and written, before there is any work to lose. Leaves nothing behind.
#pragma once

#include "base/descriptor.hpp"

#include <filesystem>

namespace triptych {

/// Error (file) unless it is a regular file that this process may read; the error says what it is: a folder,
/// a pipe, a socket or a device.
void check_readable(const std::filesystem::path& file);
/// The same, and opens it.
Descriptor open_to_read(const std::filesystem::path& file);

/// Error (folder) unless it is a folder.
void check_folder_there(const std::filesystem::path& folder);

/// Error (file) if no regular file can be written under this name.
void check_writable(const std::filesystem::path& file);
/// Error (folder) unless files can be written into it, or into a folder that can be made under this name.
void check_folder_writable(const std::filesystem::path& folder);

}  // namespace triptych
