// Files that a model names: looked for as a person would, since names were often written on another system.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// The spellings to try, best first: the name as it stands; without quotes, with slashes for backslashes; its
/// last part alone, since an absolute path of another machine is of no use here.
std::vector<std::string> spellings_of(std::string_view name);

/// Whether the names are equal but for the case of ASCII letters.
bool equal_but_for_case(std::string_view a, std::string_view b);

/// The regular file that is meant by a name, relative to the folder; among files whose name differs only in
/// case, the first in the alphabet.
std::optional<std::filesystem::path> find_beside(const std::filesystem::path& folder, std::string_view name);

}  // namespace triptych
