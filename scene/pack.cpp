#include "scene/pack.hpp"

#include "base/bytes.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "scene/pack_skeleton.hpp"

#include <string_view>

namespace triptych {

Pack::Pack(const std::filesystem::path& file) : name_(file.string()), file_(open_to_read(file)) {
  size_ = size_of(file_.number(), name_);
  read_table();
}

std::vector<std::byte> Pack::read_bytes(uint64_t offset, uint64_t count, const std::string& place) const {
  if (offset > size_ || count > size_ - offset) {
    fail(place, "byte {}: the file ends at byte {}, {} bytes were wanted", offset, size_, count);
  }
  std::vector<std::byte> bytes(static_cast<size_t>(count));
  read_at(file_.number(), offset, bytes, place);
  return bytes;
}

void Pack::read_table() {
  if (size_ < sizeof(PackHeader)) fail(name_, "is no pack: {} bytes are less than a header", size_);
  const auto header = ByteReader(read_bytes(0, sizeof(PackHeader), name_), name_).read<PackHeader>();
  if (header.signature != pack_magic) fail(name_, "is no pack: byte 0 does not start with TRIPTYCH");
  if (header.version != pack_format_version) {
    fail(name_, "is a pack of format version {}, this program reads version {}", header.version,
         pack_format_version);
  }
  const std::string table_place = name_ + ": section table";
  const auto table_bytes =
      read_bytes(header.table_offset, uint64_t{header.section_count} * sizeof(PackSection), table_place);
  if (hash_bytes(table_bytes, header.version) != header.table_checksum) {
    fail(table_place, "byte {}: the checksum does not match: the pack is damaged", header.table_offset);
  }
  if (const uint64_t end = header.table_offset + table_bytes.size(); end != size_)
    fail(name_, "byte {}: {} bytes are left over after the section table", end, size_ - end);
  ByteReader reader(table_bytes, table_place);
  const PackSection* geometry = nullptr;
  const PackSection* skeleton = nullptr;
  const auto sections = reader.read_all<PackSection>(header.section_count);
  for (const PackSection& section :
       sections) {  // sections of other types are left to programs that know them
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
