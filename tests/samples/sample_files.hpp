// Folders that samples are written to, and their models read back.
#pragma once

#include "model/import/import.hpp"

#include <filesystem>
#include <limits>
#include <string>
#include <unistd.h>

namespace triptych {

/// A name for a folder that is not there yet; what is there at the end is removed.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("triptych_sample_" + name + "_" + std::to_string(::getpid()))) {}
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The model with all its triangles in memory.
inline Model read_whole(const std::filesystem::path& file) {
  ImportOptions options;
  options.stream_above = options.max_in_memory = std::numeric_limits<uint64_t>::max();
  return import_model({file}, options);
}

}  // namespace triptych
