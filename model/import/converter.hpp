// triptych-import, the program that reads further formats with Assimp: started, watched, and ended.
#pragma once

#include "model/import/import.hpp"
#include "model/import/packed_file.hpp"

#include <memory>
#include <string>
#include <vector>

namespace triptych {

class StreamSource;

struct Converted {
  std::shared_ptr<const StreamSource> glb;  ///< in a temporary file without a name
  std::vector<std::string> warnings;
};

/// Converts the file in a process of its own, since the libraries that read these formats crash on hostile
/// files. Error (the file) where the program reports an error, crashes, takes too long or too much memory, or
/// is not installed; nothing is left behind.
/// `unpacked`: what is read in place of a compressed file, and its name; null: the file itself.
Converted convert_model(const std::filesystem::path& file, const PackedFile* unpacked,
                        const ImportOptions& options);

}  // namespace triptych
