#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/check/check.hpp"
#include "scene/pack_format.hpp"

#include <algorithm>
#include <mutex>
#include <string_view>

namespace triptych {

namespace {

/// Bytes of the file and what their checksum must be.
struct Verified {
  uint64_t offset = 0, size = 0, checksum = 0;
  std::string place;
};

/// The sections other than GEOM and TEXL, the chunks in the one, and the levels of textures in the other, in
/// the order of the file.
std::vector<Verified> verified_bytes(const Pack& pack, int file) {
  const std::string& name = pack.name();
  std::vector<std::byte> bytes(sizeof(PackHeader));
  read_at(file, 0, bytes, name);
  const auto header = ByteReader(bytes, name).read<PackHeader>();
  bytes.resize(size_t{header.section_count} * sizeof(PackSection));
  read_at(file, header.table_offset, bytes, name);
  std::vector<Verified> verified;
  for (const PackSection& section : ByteReader(bytes, name).read_all<PackSection>(header.section_count)) {
    const std::string place =
        fmt::format("{}: section {}", name, std::string_view(section.type.data(), section.type.size()));
    if (section.type == texels_type) {
      for (const Texture& texture : pack.skeleton().textures) {
        for (const TextureLevel& level : texture.levels)
          verified.push_back({section.offset + level.offset, level.size, level.checksum, place});
      }
      continue;
    }
    if (section.type != geometry_type) {
      verified.push_back({section.offset, section.size, section.checksum, place});
      continue;
    }
    const auto& chunks = pack.skeleton().chunks;
    for (size_t i = 0; i < chunks.size(); ++i)
      verified.push_back({section.offset + chunks[i].offset, chunks[i].size, chunks[i].checksum,
                          fmt::format("{}: chunk {}", place, i)});
  }
  std::ranges::sort(verified, {}, &Verified::offset);
  return verified;
}

/// Indices from ... to, of neighbouring bytes, that one thread reads.
struct Stretch {
  size_t from = 0, to = 0;
};

std::vector<Stretch> stretches_of(const std::vector<Verified>& verified) {
  constexpr uint64_t enough = uint64_t{8} << 20;
  std::vector<Stretch> stretches;
  uint64_t bytes = enough;
  for (size_t i = 0; i < verified.size(); ++i) {
    if (bytes >= enough) {
      stretches.push_back({i, i});
      bytes = 0;
    }
    stretches.back().to = i + 1;
    bytes += verified[i].size;
  }
  return stretches;
}

/// Error (place, byte) where the bytes cannot be read or are others.
void verify(const Verified& verified, int file) {
  constexpr uint64_t piece = uint64_t{1} << 20;
  StreamHash hash;
  std::vector<std::byte> bytes;
  for (uint64_t done = 0; done < verified.size; done += bytes.size()) {
    bytes.resize(static_cast<size_t>(std::min(piece, verified.size - done)));
    read_at(file, verified.offset + done, bytes, verified.place);
    hash.add(bytes);
  }
  if (hash.checksum() != verified.checksum)
    fail(verified.place, "byte {}: the checksum does not match: the pack is damaged, build it again",
         verified.offset);
}

}  // namespace

BytesReport check_bytes(const Pack& pack, const CheckOptions& options) {
  const Descriptor file = open_to_read(pack.name());
  const std::vector<Verified> verified = verified_bytes(pack, file.number());
  const std::vector<Stretch> stretches = stretches_of(verified);
  BytesReport report;
  report.chunks = pack.skeleton().chunks.size();
  for (const Verified& bytes : verified) report.bytes += bytes.size;
  std::mutex telling;
  Progress progress("check: bytes", report.bytes);
  parallel_for(stretches.size(), [&](size_t index) {
    for (size_t i = stretches[index].from; i < stretches[index].to; ++i) {
      try {
        verify(verified[i], file.number());
      } catch (const Error& error) {
        const std::lock_guard lock(telling);
        ++report.checksum_errors;
        if (report.messages.size() >= options.messages) continue;
        report.messages.emplace_back(error.what());
        if (options.found) options.found(report.messages.back());
      }
      progress.advance(verified[i].size);
    }
  });
  return report;
}

}  // namespace triptych
