#include "base/file_access.hpp"

#include "base/error.hpp"
#include "base/file.hpp"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace triptych {

namespace {

using std::filesystem::file_type;

const char* name_of(file_type type) {
  switch (type) {
    case file_type::regular:
      return "a file";
    case file_type::directory:
      return "a folder";
    case file_type::fifo:
      return "a pipe";
    case file_type::socket:
      return "a socket";
    case file_type::character:
    case file_type::block:
      return "a device";
    case file_type::not_found:
      return "a link to nothing";
    default:
      return "something unknown";
  }
}

}  // namespace

Descriptor open_to_read(const std::filesystem::path& file) {
  std::error_code error;
  const file_type type = std::filesystem::status(file, error).type();
  if (type == file_type::not_found) fail(file.string(), "cannot be opened: {}", std::strerror(ENOENT));
  if (type == file_type::none) fail(file.string(), "cannot be opened: {}", error.message());
  if (type != file_type::regular) fail(file.string(), "is {}, not a file", name_of(type));
  // O_NONBLOCK: if a pipe has taken its place meanwhile, this does not wait for a writer.
  Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!descriptor.is_open()) fail(file.string(), "cannot be opened: {}", std::strerror(errno));
  return descriptor;
}

void check_readable(const std::filesystem::path& file) { open_to_read(file); }

void check_folder_there(const std::filesystem::path& folder) {
  std::error_code error;
  const file_type type = std::filesystem::status(folder, error).type();
  if (type == file_type::none || type == file_type::not_found)
    fail(folder.string(), "cannot be opened: {}", error ? error.message() : std::strerror(ENOENT));
  if (type != file_type::directory) fail(folder.string(), "is {}, not a folder", name_of(type));
}

void check_writable(const std::filesystem::path& file) { const AtomicFile never_committed(file); }

void check_folder_writable(const std::filesystem::path& folder) {
  // Folders would be made in the nearest one that exists.
  std::filesystem::path nearest = std::filesystem::absolute(folder);
  std::error_code error;
  std::filesystem::file_status status;
  while ((status = std::filesystem::status(nearest, error)).type() == file_type::not_found &&
         !std::filesystem::is_symlink(nearest, error) && nearest.has_relative_path()) {
    nearest = nearest.parent_path();
  }
  if (status.type() == file_type::none) fail(folder.string(), "cannot be made: {}", error.message());
  if (status.type() != file_type::directory) {
    const std::string which = nearest == std::filesystem::absolute(folder) ? "" : nearest.string() + " ";
    fail(folder.string(), "{}is {}, not a folder", which, name_of(status.type()));
  }
  std::string trial = (nearest / "triptych-XXXXXX").string();
  if (!::mkdtemp(trial.data())) fail(folder.string(), "cannot be written: {}", std::strerror(errno));
  ::rmdir(trial.c_str());
}

}  // namespace triptych
