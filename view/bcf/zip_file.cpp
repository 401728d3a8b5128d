#include "view/bcf/zip_file.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/one_line.hpp"
#include "base/partial_files.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unzip.h>
#include <utility>
#include <zip.h>

namespace triptych {

struct ZipReader::Archive {
  explicit Archive(const std::filesystem::path& file) : zip(unzOpen64(file.c_str())) {}
  ~Archive() {
    if (zip) unzClose(zip);
  }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;
  unzFile zip;
  std::unordered_map<std::string, unz64_file_pos>
      places;  ///< of members; of a name that is there twice the first
};

ZipReader::ZipReader(const std::filesystem::path& file) : place_(file.string()) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) fail(place_, "is no file that can be read");
  archive_ = std::make_unique<Archive>(file);
  unzFile zip = archive_->zip;
  if (!zip) fail(place_, "is not a zip archive, or its end is missing");
  for (int found = unzGoToFirstFile(zip); found == UNZ_OK; found = unzGoToNextFile(zip)) {
    std::array<char, 4096> name{};
    unz_file_info64 info{};
    if (unzGetCurrentFileInfo64(zip, &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) != UNZ_OK)
      fail(place_, "the directory of the zip archive is damaged");
    std::string member(name.data());
    unz64_file_pos at{};
    if (unzGetFilePos64(zip, &at) != UNZ_OK) fail(place_, "the directory of the zip archive is damaged");
    archive_->places.emplace(member, at);
    if (!member.empty() && member.back() != '/') members_.push_back(std::move(member));
    if (members_.size() > max_members) fail(place_, "has more than {} members", max_members);
  }
}

ZipReader::~ZipReader() = default;

bool ZipReader::has(const std::string& member) const { return archive_->places.contains(member); }

std::string ZipReader::read(const std::string& member) const {
  const std::string place = fmt::format("{}: {}", place_, one_line(member.substr(0, 120)));
  unzFile zip = archive_->zip;
  unz_file_info64 info{};
  const auto at = archive_->places.find(member);
  if (at == archive_->places.end() || unzGoToFilePos64(zip, &at->second) != UNZ_OK ||
      unzGetCurrentFileInfo64(zip, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    fail(place, "is not in the archive");
  if ((info.flag & 1) != 0) fail(place, "is encrypted");
  const bool is_known = info.compression_method == 0 || info.compression_method == Z_DEFLATED;
  if (!is_known || unzOpenCurrentFile(zip) != UNZ_OK)
    fail(place, "cannot be unpacked (method {})", info.compression_method);
  std::string text;
  std::array<char, 1 << 16> block{};
  int count = 0;
  while ((count = unzReadCurrentFile(zip, block.data(), static_cast<unsigned>(block.size()))) > 0 &&
         text.size() <= max_member_bytes)
    text.append(block.data(), static_cast<size_t>(count));
  const bool too_long = text.size() > max_member_bytes;
  const int closed = unzCloseCurrentFile(zip);  // which compares the checksum, if all was read
  if (too_long) fail(place, "unpacks to more than {} MiB", max_member_bytes >> 20);
  if (count < 0 || closed != UNZ_OK) fail(place, "is damaged within the archive");
  return text;
}

ZipWriter::ZipWriter(std::filesystem::path file)
    : file_(std::move(file)), partial_(partial_name(file_)), held_(open_partial_file(partial_)) {
  if (held_) zip_ = zipOpen64(partial_.c_str(), APPEND_STATUS_CREATE);
  if (!zip_) {
    release();
    fail(file_.string(), "cannot be written");
  }
}

ZipWriter::~ZipWriter() {
  if (!zip_) return;
  zipClose(zip_, nullptr);
  release();
}

void ZipWriter::release() {
  if (!held_) return;
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
  std::fclose(std::exchange(held_, nullptr));
}

void ZipWriter::add(const std::string& member, std::span<const std::byte> bytes) {
  zip_fileinfo info{};
  info.tmz_date = {0, 0, 0, 1, 0, 1980};  // the first that archives know
  bool good = zipOpenNewFileInZip64(zip_, member.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                                    Z_DEFAULT_COMPRESSION, 0) == ZIP_OK;
  good = good && (bytes.empty() ||
                  zipWriteInFileInZip(zip_, bytes.data(), static_cast<unsigned>(bytes.size())) == ZIP_OK);
  if (!good || zipCloseFileInZip(zip_) != ZIP_OK) fail(file_.string(), "cannot be written");
}

void ZipWriter::add(const std::string& member, const std::string& text) {
  add(member, std::as_bytes(std::span(text)));
}

void ZipWriter::commit() {
  const bool closed = zipClose(std::exchange(zip_, nullptr), nullptr) == ZIP_OK;
  std::error_code error;
  if (closed) std::filesystem::rename(partial_, file_, error);
  release();
  if (closed && !error) return;
  fail(file_.string(), "cannot be written{}{}", error ? ": " : "", error ? error.message() : "");
}

}  // namespace triptych
