#include "samples/building/zip_archive.hpp"

#include "base/error.hpp"

#include <unordered_map>
#include <unzip.h>

namespace triptych {
namespace {

struct Entry {
  unz64_file_pos position;
  uint64_t bytes;
};

}  // namespace

struct ZipArchive::Directory {
  ~Directory() {
    if (file) unzClose(file);
  }
  unzFile file = nullptr;
  std::unordered_map<std::string, Entry> entries;
};

ZipArchive::ZipArchive(const std::filesystem::path& path)
    : path_(path), directory_(std::make_unique<Directory>()) {
  directory_->file = unzOpen64(path.c_str());
  if (!directory_->file) fail(path.string(), "cannot be opened as a zip archive");
  int status = unzGoToFirstFile(directory_->file);
  for (; status == UNZ_OK; status = unzGoToNextFile(directory_->file)) {
    unz_file_info64 information;
    char name[1024];
    Entry entry{};
    if (unzGetCurrentFileInfo64(directory_->file, &information, name, sizeof(name), nullptr, 0, nullptr, 0) !=
            UNZ_OK ||
        unzGetFilePos64(directory_->file, &entry.position) != UNZ_OK)
      fail(path.string(), "damaged directory after {} files", directory_->entries.size());
    entry.bytes = information.uncompressed_size;
    directory_->entries.emplace(name, entry);
  }
  if (status != UNZ_END_OF_LIST_OF_FILE)
    fail(path.string(), "damaged directory after {} files", directory_->entries.size());
}

ZipArchive::~ZipArchive() = default;

bool ZipArchive::contains(const std::string& name) const { return directory_->entries.count(name) > 0; }

uint64_t ZipArchive::size(const std::string& name) const {
  const auto found = directory_->entries.find(name);
  return found == directory_->entries.end() ? 0 : found->second.bytes;
}

std::string ZipArchive::read(const std::string& name) const {
  const std::string place = path_.string() + "!" + name;
  const auto found = directory_->entries.find(name);
  if (found == directory_->entries.end()) fail(place, "not in the archive");
  // A directory that promises more than this is damaged: the largest real file is a hundredth of it.
  constexpr uint64_t largest = uint64_t{1} << 30;
  if (found->second.bytes > largest) fail(place, "promises {} bytes", found->second.bytes);
  std::string bytes(static_cast<size_t>(found->second.bytes), '\0');
  const std::lock_guard lock(mutex_);
  unz64_file_pos position = found->second.position;
  if (unzGoToFilePos64(directory_->file, &position) != UNZ_OK ||
      unzOpenCurrentFile(directory_->file) != UNZ_OK)
    fail(place, "cannot be opened");
  const int count = unzReadCurrentFile(directory_->file, bytes.data(), static_cast<unsigned>(bytes.size()));
  const int closed = unzCloseCurrentFile(directory_->file);
  if (count < 0 || static_cast<size_t>(count) != bytes.size() || closed != UNZ_OK) fail(place, "damaged");
  return bytes;
}

}  // namespace triptych
