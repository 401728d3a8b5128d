// The programs that read further formats with large libraries: started, watched, and ended.
#pragma once

#include "model/import/import.hpp"
#include "model/import/packed_file.hpp"

#include <memory>
#include <string>
#include <vector>

namespace triptych {

class StreamSource;

struct Converted {
  std::shared_ptr<const StreamSource> output;  ///< in a temporary file without a name
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> also_read;  ///< files that it opened beside the model
};

/// One of the programs beside this one.
struct Converter {
  std::string program;             ///< ImportOptions::converter stands in for it, where that is set
  std::string library;             ///< that it reads with, for messages
  std::vector<std::string> flags;  ///< before "--memory BYTES FILE"
};

/// Converts the file in a process of its own, since the libraries that read these formats crash on hostile
/// files. The program writes to descriptor 3, and to its standard error lines that begin with "triptych: "
/// (what is wrong, at the end), "warning: ", "reads: FILE"
/// (beside the model), or "progress: DONE TOTAL". Error (the file) where it reports an
/// error, crashes, takes too long or too much memory, or is not installed; nothing is left behind.
/// `unpacked`: what is read in place of a compressed file, and its name; null: the file itself.
Converted convert_model(const std::filesystem::path& file, const PackedFile* unpacked,
                        const ImportOptions& options, const Converter& converter);

}  // namespace triptych
