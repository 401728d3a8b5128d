#include "model/import/packed_file.hpp"

#include "base/error.hpp"
#include "base/one_line.hpp"
#include "model/import/beside.hpp"
#include "model/import/byte_spool.hpp"

#include <algorithm>
#include <zlib.h>

namespace triptych {

namespace {

bool has_extension(const std::filesystem::path& file, std::string_view extension) {
  return equal_but_for_case(file.extension().string(), extension);
}

/// Unpacks gzip: one member after the other, as gzip itself does; what follows them is left.
std::shared_ptr<const StreamSource> unpack_gzip(const std::shared_ptr<const StreamSource>& source,
                                                const ImportOptions& options) {
  const std::string& place = source->name();
  constexpr size_t block_bytes = size_t{1} << 18;
  constexpr int with_gzip_header = 15 + 16;
  SourceReader reader(source);
  UnpackedBytes unpacked(place, options.temporary_folder);
  std::vector<std::byte> in(block_bytes), out(block_bytes);
  z_stream stream{};
  if (inflateInit2(&stream, with_gzip_header) != Z_OK) fail(place, "gzip cannot be unpacked");
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  uint64_t offset = 0;
  bool any = false, within = true;
  while (offset < source->size() || stream.avail_in > 0) {
    if (stream.avail_in == 0) {
      const auto count = static_cast<size_t>(std::min<uint64_t>(block_bytes, source->size() - offset));
      reader.read(offset, std::span(in).first(count));
      offset += count;
      stream.next_in = reinterpret_cast<Bytef*>(in.data());
      stream.avail_in = static_cast<uInt>(count);
    }
    int result = Z_OK;
    do {
      stream.next_out = reinterpret_cast<Bytef*>(out.data());
      stream.avail_out = block_bytes;
      result = inflate(&stream, Z_NO_FLUSH);
      unpacked.append(std::span(out).first(block_bytes - stream.avail_out));
    } while (result == Z_OK && stream.avail_out == 0);
    within = result != Z_STREAM_END;
    if (result == Z_STREAM_END) {
      any = true;
      inflateReset(&stream);
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      if (any && stream.total_out == 0) return unpacked.take();  // padding behind the last member
      fail(place, "the gzip data are damaged ({} bytes of them unpacked)", stream.total_out);
    }
  }
  if (within) fail(place, "the gzip data end too soon");
  return unpacked.take();
}

bool is_hidden(const std::filesystem::path& member) {
  return std::any_of(member.begin(), member.end(), [](const std::filesystem::path& part) {
    return part.string().starts_with('.') || part == "__MACOSX";
  });
}

}  // namespace

bool is_packed(const std::filesystem::path& file) {
  return has_extension(file, ".gz") || has_extension(file, ".zip");
}

PackedFile find_packed(const std::filesystem::path& file,
                       const std::function<bool(const std::filesystem::path&)>& is_model,
                       const std::function<bool(const std::filesystem::path&)>& preferred) {
  if (has_extension(file, ".gz")) return {file.stem(), nullptr, nullptr};
  auto archive = std::make_shared<ModelArchive>(std::make_shared<StreamSource>(file));
  std::vector<std::string> models;
  for (const auto& wanted : {preferred, is_model}) {
    if (!models.empty()) break;
    for (const std::string& member : archive->members()) {
      if (!is_hidden(member) && wanted(member)) models.push_back(member);
    }
  }
  if (models.empty()) fail(file.string(), "the archive holds no model that is known by its name");
  if (models.size() > 1)
    fail(file.string(), "the archive holds {} models ({}, {} ...); unpack it and name those that you want",
         models.size(), one_line(models[0].substr(0, 60)), one_line(models[1].substr(0, 60)));
  return {models[0], nullptr, std::move(archive)};
}

void unpack(const std::filesystem::path& file, PackedFile& packed, const ImportOptions& options) {
  packed.content = packed.archive ? packed.archive->read(packed.name.string(), options)
                                  : unpack_gzip(std::make_shared<StreamSource>(file), options);
}

}  // namespace triptych
