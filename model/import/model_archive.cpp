#include "model/import/model_archive.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/beside.hpp"
#include "model/import/byte_spool.hpp"

#include <algorithm>
#include <array>
#include <unzip.h>

namespace triptych {

namespace {

/// A source as the file that minizip reads.
struct SourceFile {
  explicit SourceFile(std::shared_ptr<const StreamSource> source) : reader(std::move(source)) {}
  SourceReader reader;
  uint64_t at = 0;
  uint64_t size() const { return reader.source().size(); }
};

zlib_filefunc64_def functions_of(SourceFile& file) {
  zlib_filefunc64_def functions{};
  functions.opaque = &file;
  functions.zopen64_file = [](voidpf opaque, const void*, int) -> voidpf { return opaque; };
  functions.zread_file = [](voidpf opaque, voidpf, void* into, uLong count) -> uLong {
    auto& source = *static_cast<SourceFile*>(opaque);
    const auto taken = static_cast<size_t>(std::min<uint64_t>(count, source.size() - source.at));
    try {
      source.reader.read(source.at, {static_cast<std::byte*>(into), taken});
    } catch (const Error&) {
      return 0;  // minizip says that the archive is damaged
    }
    source.at += taken;
    return static_cast<uLong>(taken);
  };
  functions.ztell64_file = [](voidpf opaque, voidpf) -> ZPOS64_T {
    return static_cast<SourceFile*>(opaque)->at;
  };
  functions.zseek64_file = [](voidpf opaque, voidpf, ZPOS64_T offset, int origin) -> long {
    auto& source = *static_cast<SourceFile*>(opaque);
    const uint64_t from = origin == ZLIB_FILEFUNC_SEEK_SET   ? 0
                          : origin == ZLIB_FILEFUNC_SEEK_CUR ? source.at
                                                             : source.size();
    const uint64_t to = from + offset;
    if (to > source.size()) return -1;
    source.at = to;
    return 0;
  };
  functions.zclose_file = [](voidpf, voidpf) { return 0; };
  functions.zerror_file = [](voidpf, voidpf) { return 0; };
  return functions;
}

}  // namespace

struct ModelArchive::Reading {
  explicit Reading(std::shared_ptr<const StreamSource> source) : file(std::move(source)) {
    zlib_filefunc64_def functions = functions_of(file);
    zip = unzOpen2_64("", &functions);
  }
  ~Reading() {
    if (zip) unzClose(zip);
  }
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  SourceFile file;
  unzFile zip = nullptr;
};

ModelArchive::ModelArchive(std::shared_ptr<const StreamSource> source)
    : reading_(std::make_unique<Reading>(source)), place_(source->name()) {
  if (!reading_->zip) fail(place_, "is not a zip archive, or its end is missing");
  for (int found = unzGoToFirstFile(reading_->zip); found == UNZ_OK; found = unzGoToNextFile(reading_->zip)) {
    unz_file_info64 info{};
    std::array<char, 4096> name{};
    if (unzGetCurrentFileInfo64(reading_->zip, &info, name.data(), name.size() - 1, nullptr, 0, nullptr, 0) !=
        UNZ_OK)
      fail(place_, "the directory of the zip archive is damaged");
    std::string member(name.data());
    if (!member.empty() && member.back() != '/' && member.back() != '\\') members_.push_back(member);
  }
}

ModelArchive::~ModelArchive() = default;

const std::string* ModelArchive::find(std::string_view name) const {
  const auto exact = std::find(members_.begin(), members_.end(), name);
  const auto found = exact != members_.end()
                         ? exact
                         : std::find_if(members_.begin(), members_.end(), [&](const std::string& member) {
                             return equal_but_for_case(member, name);
                           });
  return found == members_.end() ? nullptr : &*found;
}

std::shared_ptr<const StreamSource> ModelArchive::read(const std::string& member,
                                                       const ImportOptions& options) const {
  const std::string place = fmt::format("{}: {}", place_, one_line(member.substr(0, 120)));
  unzFile zip = reading_->zip;
  unz_file_info64 info{};
  if (unzLocateFile(zip, member.c_str(), 1) != UNZ_OK ||
      unzGetCurrentFileInfo64(zip, &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    fail(place, "is not in the archive");
  if ((info.flag & 1) != 0) fail(place, "is encrypted; unpack the archive");
  if (unzOpenCurrentFile(zip) != UNZ_OK)
    fail(place, "cannot be unpacked (method {}); unpack the archive with the program that made it",
         info.compression_method);
  UnpackedBytes unpacked(place, options.temporary_folder);
  std::vector<std::byte> block(size_t{1} << 16);
  int count = 0;
  while ((count = unzReadCurrentFile(zip, block.data(), static_cast<unsigned>(block.size()))) > 0)
    unpacked.append(std::span(block).first(static_cast<size_t>(count)));
  const int closed = unzCloseCurrentFile(zip);  // which compares the checksum
  if (count < 0 || closed != UNZ_OK) fail(place, "is damaged within the archive");
  return unpacked.take();
}

std::shared_ptr<const StreamSource> ModelArchive::beside(const std::filesystem::path& from,
                                                         std::string_view name,
                                                         const ImportOptions& options) const {
  for (const std::string& spelling : spellings_of(name)) {
    const auto path = (from.parent_path() / spelling).lexically_normal().generic_string();
    if (const std::string* member = find(path)) return read(*member, options);
  }
  return nullptr;
}

}  // namespace triptych
