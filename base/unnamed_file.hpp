// Temporary files without a name: nothing is left of them however the program ends.
#pragma once

#include "base/spool_file.hpp"

#include <filesystem>
#include <memory>

namespace triptych {

/// Opens a new file in the folder, for reading and writing, and unlinks it; empty: TMPDIR or /tmp.
/// Programs that are started do not inherit it. Error (folder) if that fails.
Descriptor open_unnamed_file(const std::filesystem::path& folder);
std::shared_ptr<SpoolFile> open_unnamed_spool(const std::filesystem::path& folder);

}  // namespace triptych
