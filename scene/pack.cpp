#include "scene/pack.hpp"

#include "base/bytes.hpp"
#include "base/descriptor.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "base/unnamed_file.hpp"
#include "scene/pack_skeleton.hpp"

#include <array>
#include <cstring>
#include <fstream>
#include <unistd.h>

namespace triptych {

namespace {

constexpr std::array<char, 8> magic = {'T', 'R', 'I', 'P', 'T', 'Y', 'C', 'H'};
constexpr std::array<char, 4> geometry_type = {'G', 'E', 'O', 'M'};
constexpr std::array<char, 4> skeleton_type = {'S', 'K', 'E', 'L'};

struct Header {
  std::array<char, 8> signature = magic;
  uint32_t version = pack_format_version;
  uint32_t section_count = 0;
  uint64_t table_offset = 0;
  uint64_t table_checksum = 0;  ///< of the table's bytes, seeded with the version
};
static_assert(sizeof(Header) == 32);

struct Section {
  std::array<char, 4> type{};
  uint32_t version = 1;
  uint64_t offset = 0, size = 0;
  uint64_t checksum = 0;
};
static_assert(sizeof(Section) == 32);

/// The geometry section is too large to be read at once: its checksum is that of its chunks' checksums in
/// order.
uint64_t geometry_checksum(const std::vector<ChunkInfo>& chunks) {
  std::vector<uint64_t> checksums;
  checksums.reserve(chunks.size());
  for (const ChunkInfo& chunk : chunks) checksums.push_back(chunk.checksum);
  return hash_values(std::span<const uint64_t>(checksums));
}

void write_unfinished_header(AtomicFile& file) {
  const Header unfinished{.signature = {}};
  file.write(std::as_bytes(std::span(&unfinished, 1)));
}

/// Takes back what a process wrote that was killed before its pack had its name. Where that fails the file
/// cannot be gone on with either, and whoever tries says so.
const std::filesystem::path& without_header(const std::filesystem::path& partial, uint64_t kept) {
  const Header unfinished{.signature = {}};
  if (kept >= sizeof(Header)) {
    std::fstream file(partial, std::ios::in | std::ios::out | std::ios::binary);
    file.write(reinterpret_cast<const char*>(&unfinished), sizeof(unfinished));
  }
  return partial;
}

}  // namespace

EncodedChunk::EncodedChunk(const Chunk& chunk)
    : bytes(encode_chunk(chunk)),
      triangles(static_cast<uint32_t>(chunk.triangle_count())),
      box(chunk.box()),
      pieces(chunk.pieces()) {
  // The codec drops vertices that no triangle uses, so the bytes say how many there are.
  std::memcpy(&vertices, bytes.data(), sizeof(vertices));
}

PackWriter::PackWriter(const std::filesystem::path& file)
    : file_(file),
      pieces_(file.string() + ": a temporary file", open_unnamed_file(file.parent_path() / ".")) {
  write_unfinished_header(file_);
}

PackWriter::PackWriter(const std::filesystem::path& file, const std::filesystem::path& partial, Kept kept)
    : file_(file, without_header(partial, kept.pack.size), kept.pack),
      pieces_(std::filesystem::path(partial) += ".pieces", kept.pieces) {
  if (kept.pack.size == 0) write_unfinished_header(file_);
}

PackWriter::Kept PackWriter::flush() { return {file_.flush(), pieces_.kept()}; }

uint32_t PackWriter::add_chunk(const Chunk& chunk, uint32_t lattice) {
  return add_chunk(EncodedChunk(chunk), lattice);
}

uint32_t PackWriter::add_chunk(const EncodedChunk& chunk, uint32_t lattice) {
  chunks_.push_back({.offset = file_.size() - sizeof(Header),
                     .size = chunk.bytes.size(),
                     .checksum = hash_bytes(chunk.bytes),
                     .vertex_count = chunk.vertices,
                     .triangle_count = chunk.triangles,
                     .lattice = lattice,
                     .first_piece = static_cast<uint32_t>(pieces_.size() / sizeof(LatticeBox)),
                     .box = chunk.box});
  if (!chunk.pieces.empty()) pieces_.append(std::as_bytes(std::span(chunk.pieces)));
  file_.write(chunk.bytes);
  return static_cast<uint32_t>(chunks_.size() - 1);
}

void PackWriter::adopt(std::span<const ChunkInfo> chunks) {
  chunks_.insert(chunks_.end(), chunks.begin(), chunks.end());
}

void PackWriter::finish(Skeleton skeleton) {
  skeleton.chunks = std::move(chunks_);
  const uint64_t geometry_end = file_.size();
  StreamHash hash;
  const auto write = [&](std::span<const std::byte> bytes) {
    hash.add(bytes);
    file_.write(bytes);
  };
  write_skeleton(skeleton, pieces_.size() / sizeof(LatticeBox), write);
  pieces_.read_all(write);
  const std::array<Section, 2> table = {Section{.type = geometry_type,
                                                .offset = sizeof(Header),
                                                .size = geometry_end - sizeof(Header),
                                                .checksum = geometry_checksum(skeleton.chunks)},
                                        Section{.type = skeleton_type,
                                                .offset = geometry_end,
                                                .size = file_.size() - geometry_end,
                                                .checksum = hash.checksum()}};
  const auto table_bytes = std::as_bytes(std::span(table));
  const Header header{.section_count = static_cast<uint32_t>(table.size()),
                      .table_offset = file_.size(),
                      .table_checksum = hash_bytes(table_bytes, pack_format_version)};
  file_.write(table_bytes);
  file_.write_at(0, std::as_bytes(std::span(&header, 1)));
  file_.commit();
}

Pack::Pack(const std::filesystem::path& file) : name_(file.string()), file_(open_to_read(file)) {
  try {
    size_ = size_of(file_, name_);
    read_table();
  } catch (...) {
    ::close(file_);
    throw;
  }
}

Pack::~Pack() { ::close(file_); }

std::vector<std::byte> Pack::read_bytes(uint64_t offset, uint64_t count, const std::string& place) const {
  if (offset > size_ || count > size_ - offset) {
    fail(place, "byte {}: the file ends at byte {}, {} bytes were wanted", offset, size_, count);
  }
  std::vector<std::byte> bytes(static_cast<size_t>(count));
  read_at(file_, offset, bytes, place);
  return bytes;
}

void Pack::read_table() {
  if (size_ < sizeof(Header)) fail(name_, "is no pack: {} bytes are less than a header", size_);
  const auto header = ByteReader(read_bytes(0, sizeof(Header), name_), name_).read<Header>();
  if (header.signature != magic) fail(name_, "is no pack: byte 0 does not start with TRIPTYCH");
  if (header.version != pack_format_version) {
    fail(name_, "is a pack of format version {}, this program reads version {}", header.version,
         pack_format_version);
  }
  const std::string table_place = name_ + ": section table";
  const auto table_bytes =
      read_bytes(header.table_offset, uint64_t{header.section_count} * sizeof(Section), table_place);
  if (hash_bytes(table_bytes, header.version) != header.table_checksum) {
    fail(table_place, "byte {}: the checksum does not match: the pack is damaged", header.table_offset);
  }
  if (const uint64_t end = header.table_offset + table_bytes.size(); end != size_)
    fail(name_, "byte {}: {} bytes are left over after the section table", end, size_ - end);
  ByteReader reader(table_bytes, table_place);
  const Section* geometry = nullptr;
  const Section* skeleton = nullptr;
  const auto sections = reader.read_all<Section>(header.section_count);
  for (const Section& section : sections) {  // sections of other types are left to programs that know them
    for (const auto& [type, found] : {std::pair(geometry_type, &geometry), {skeleton_type, &skeleton}}) {
      if (section.type != type) continue;
      if (*found) fail(table_place, "names two {} sections", std::string_view(type.data(), type.size()));
      *found = &section;
    }
  }
  if (!geometry || !skeleton) fail(table_place, "names no {} section", geometry ? "SKEL" : "GEOM");
  if (geometry->version != 1 || skeleton->version != 1)
    fail(table_place, "holds sections of a newer version");
  if (geometry->offset > size_ || geometry->size > size_ - geometry->offset) {
    fail(name_ + ": section GEOM", "leaves the file");
  }
  geometry_offset_ = geometry->offset;
  geometry_size_ = geometry->size;
  const std::string skeleton_place = name_ + ": section SKEL";
  const auto skeleton_bytes = read_bytes(skeleton->offset, skeleton->size, skeleton_place);
  if (hash_bytes(skeleton_bytes) != skeleton->checksum) {
    fail(skeleton_place, "byte {}: the checksum does not match: the pack is damaged", skeleton->offset);
  }
  skeleton_ = decode_skeleton(skeleton_bytes, geometry_size_, skeleton_place);
  if (geometry_checksum(skeleton_.chunks) != geometry->checksum) {
    fail(name_ + ": section GEOM", "its checksum does not match the skeleton's chunks: the pack is spliced");
  }
  content_hash_ = hash_bytes(skeleton_bytes, header.version);
}

Chunk Pack::read_chunk(uint32_t chunk) const {
  const ChunkInfo& info = skeleton_.chunks.at(chunk);
  const std::string place = fmt::format("{}: section GEOM: chunk {}", name_, chunk);
  const auto bytes = read_bytes(geometry_offset_ + info.offset, info.size, place);
  if (hash_bytes(bytes) != info.checksum) {
    fail(place, "byte {}: the checksum does not match: the pack is damaged", geometry_offset_ + info.offset);
  }
  return decode_chunk(bytes, info, skeleton_.pieces_of(chunk), skeleton_.palette.size(), place);
}

}  // namespace triptych
