// Packs that one command reads side by side: what each is called in tables.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// Of each file its name, with as many folders before it as tell it from the others: "x/m.tpk" and "y/m.tpk".
/// Error (the later one) if two are the same file, also by another path to it.
std::vector<std::string> pack_labels(std::span<const std::filesystem::path> files);

}  // namespace triptych
