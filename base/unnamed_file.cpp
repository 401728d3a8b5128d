#include "base/unnamed_file.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace triptych {

Descriptor open_unnamed_file(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path place = folder.empty() ? std::filesystem::temp_directory_path(error) : folder;
  std::string pattern = (place / ".triptych-XXXXXX").string();
  Descriptor descriptor(::mkostemp(pattern.data(), O_CLOEXEC));
  if (!descriptor.is_open()) fail(place.string(), "cannot hold a temporary file: {}", std::strerror(errno));
  ::unlink(pattern.c_str());
  return descriptor;
}

std::shared_ptr<SpoolFile> open_unnamed_spool(const std::filesystem::path& folder) {
  const std::string name = folder.empty() ? "the folder for temporary files" : folder.string();
  return std::make_shared<SpoolFile>(name + ": a temporary file", open_unnamed_file(folder));
}

}  // namespace triptych
