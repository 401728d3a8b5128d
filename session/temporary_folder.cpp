#include "session/temporary_folder.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <unistd.h>

namespace triptych {

TemporaryFolder::TemporaryFolder(std::filesystem::path parent) {
  std::error_code error;
  if (parent.empty()) parent = std::filesystem::temp_directory_path(error);
  if (error) fail("TMPDIR", "names no folder for temporary files: {}", error.message());
  std::string pattern = (parent / "triptych-XXXXXX").string();
  if (!::mkdtemp(pattern.data())) fail(pattern, "cannot be made: {}", std::strerror(errno));
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // what cannot be removed does no harm
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace triptych
