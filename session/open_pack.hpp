// A pack by its name: a file, or an address on a web server.
#pragma once

#include "scene/pack.hpp"

#include <filesystem>
#include <string>

namespace triptych {

/// Error as Pack and open_http().
Pack open_pack(const std::filesystem::path& name);

/// The name that means the same in every folder.
std::string lasting_name(const std::filesystem::path& name);

}  // namespace triptych
