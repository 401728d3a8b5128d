// Model files that are compressed: NAME.EXTENSION.gz, and .zip archives with one model in them.
#pragma once

#include "model/import/model_archive.hpp"

#include <filesystem>
#include <functional>
#include <memory>

namespace triptych {

/// What is read in place of a compressed file.
struct PackedFile {
  std::filesystem::path name;  ///< whose extension says the format; in an archive the member's
  std::shared_ptr<const StreamSource> content;  ///< null: not unpacked yet
  std::shared_ptr<const ModelArchive> archive;  ///< null unless it is one
};

/// Whether the file's name is that of a compressed one.
bool is_packed(const std::filesystem::path& file);

/// The model within the file, without its content. Error (file) for an archive that cannot be read, holds no
/// model whose extension is_model knows, or several; those of `preferred` come before others.
PackedFile find_packed(const std::filesystem::path& file,
                       const std::function<bool(const std::filesystem::path&)>& is_model,
                       const std::function<bool(const std::filesystem::path&)>& preferred);

/// Unpacks the content. Error (file) if it is damaged.
void unpack(const std::filesystem::path& file, PackedFile& packed, const ImportOptions& options);

}  // namespace triptych
