#include "scene/pack.hpp"

#include "base/bytes.hpp"
#include "base/descriptor.hpp"
#include "base/file_access.hpp"
#include "base/hashing.hpp"
#include "scene/closed_surfaces.hpp"
#include "scene/expand.hpp"
#include "scene/pack_motion.hpp"
#include "scene/pack_objects.hpp"
#include "scene/pack_skeleton.hpp"
#include "scene/seen_from_outside.hpp"

#include <algorithm>
#include <string_view>

namespace triptych {

namespace {

class FileSource final : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& file)
      : name_(file.string()), file_(open_to_read(file)), size_(size_of(file_.number(), name_)) {}
  const std::string& name() const override { return name_; }
  uint64_t size() const override { return size_; }
  void read(uint64_t offset, std::span<std::byte> into, const std::string& place) const override {
    read_at(file_.number(), offset, into, place);
  }

 private:
  std::string name_;
  Descriptor file_;
  uint64_t size_;
};

}  // namespace

Pack::Pack(const std::filesystem::path& file) : Pack(std::make_unique<const FileSource>(file)) {}

Pack::Pack(std::unique_ptr<const ByteSource> source) : source_(std::move(source)) { read(); }

std::vector<std::byte> Pack::read_bytes(uint64_t offset, uint64_t count, const std::string& place) const {
  if (offset > size() || count > size() - offset) {
    fail(place, "byte {}: the file ends at byte {}, {} bytes were wanted", offset, size(), count);
  }
  std::vector<std::byte> bytes(static_cast<size_t>(count));
  source_->read(offset, bytes, place);
  return bytes;
}

void Pack::read() {
  const std::vector<PackSection> table = read_table();
  const auto [geometry, skeleton, sub_hierarchies] = find_sections(table);
  if (geometry->offset > size() || geometry->size > size() - geometry->offset) {
    fail(name() + ": section GEOM", "leaves the file");
  }
  geometry_offset_ = geometry->offset;
  geometry_size_ = geometry->size;
  const std::string skeleton_place = name() + ": section SKEL";
  const auto skeleton_bytes = read_section(*skeleton, skeleton_place);
  if (sub_hierarchies) {
    const std::string sub_place = name() + ": section SUBH";
    const auto sub_bytes = read_section(*sub_hierarchies, sub_place);
    StoredSkeleton stored =
        decode_skeleton({skeleton_bytes, skeleton_place}, {sub_bytes, sub_place}, geometry_size_);
    if (motion_) stored.motion = read_motion(stored.instances.size());
    skeleton_ = expand(std::move(stored), sub_place);
    content_hash_ = instanced_content_hash(skeleton->checksum, sub_hierarchies->checksum);
  } else {
    if (motion_) fail(name() + ": section MOVE", "is in a pack without sub-hierarchies: build it again");
    skeleton_ = decode_skeleton(skeleton_bytes, geometry_size_, skeleton_place);
    content_hash_ = hash_bytes(skeleton_bytes, format_version_);
  }
  if (geometry_checksum(skeleton_.chunks) != geometry->checksum) {
    fail(name() + ": section GEOM",
         "its checksum does not match the skeleton's chunks: they come from different packs, build it again");
  }
  read_drawn_sections();
}

/// What else decides about what is drawn.
void Pack::read_drawn_sections() {
  const auto add_to_hash = [&](const PackSection& section) {
    const std::array hashes = {content_hash_, section.checksum};
    content_hash_ = hash_values(std::span<const uint64_t>(hashes), format_version_);
  };
  const auto read = [&](const std::optional<PackSection>& section, const char* type, uint32_t version,
                        const auto& decode) {
    if (!section) return;
    const std::string place = name() + ": section " + type;
    check_version(*section, version, place);
    decode(read_section(*section, place), place);
    add_to_hash(*section);
  };
  read(seen_from_outside_, "SEEN", seen_from_outside_version, [&](const auto& bytes, const auto& place) {
    skeleton_.seen_from_outside = decode_seen_from_outside(bytes, skeleton_.chunks.size(), place);
  });
  read(closed_surfaces_, "BODY", closed_surfaces_version, [&](const auto& bytes, const auto& place) {
    skeleton_.closed = decode_closed_surfaces(bytes, skeleton_.chunks, place);
    skeleton_.closed.find_reach(skeleton_);
  });
  read(materials_, "MATL", materials_version, [&](const auto& bytes, const auto& place) {
    decode_materials(bytes, texels_ ? texels_->size : 0, place, skeleton_);
    if (!texels_) return;
    const std::string texels_place = name() + ": section TEXL";
    check_version(*texels_, texels_version, texels_place);
    if (texels_->offset > size() || texels_->size > size() - texels_->offset)
      fail(texels_place, "leaves the file");
    if (texels_checksum(skeleton_.textures) != texels_->checksum)
      fail(texels_place, "its checksum does not match the textures of section MATL: build the pack again");
  });
  if (motion_) add_to_hash(*motion_);  // read before, since the skeleton was expanded with it
  read(geo_place_, "SKYL", geo_place_version,
       [&](const auto& bytes, const auto& place) { skeleton_.geo_place = decode_geo_place(bytes, place); });
}

StoredMotion Pack::read_motion(size_t instances) const {
  const std::string place = name() + ": section MOVE";
  check_version(*motion_, motion_version, place);
  return decode_motion(read_section(*motion_, place), instances, place);
}

std::vector<PackSection> Pack::read_table() {
  if (size() < sizeof(PackHeader)) fail(name(), "is not a pack: {} bytes are less than a header", size());
  const auto header = ByteReader(read_bytes(0, sizeof(PackHeader), name()), name()).read<PackHeader>();
  if (header.signature != pack_magic)
    fail(name(), "is not a pack: it does not start with TRIPTYCH; `triptych build` makes one");
  format_version_ = header.version;
  if (format_version_ != pack_format_version && format_version_ != instanced_pack_format_version) {
    fail(name(), "is a pack of format version {}, this program reads versions {} and {}: build it again",
         format_version_, pack_format_version, instanced_pack_format_version);
  }
  const std::string table_place = name() + ": section table";
  const auto table_bytes =
      read_bytes(header.table_offset, uint64_t{header.section_count} * sizeof(PackSection), table_place);
  if (hash_bytes(table_bytes, header.version) != header.table_checksum) {
    fail(table_place, "byte {}: the checksum does not match: the pack is damaged, build it again",
         header.table_offset);
  }
  if (const uint64_t end = header.table_offset + table_bytes.size(); end != size())
    fail(name(), "byte {}: {} bytes are left over after the section table", end, size() - end);
  return ByteReader(table_bytes, table_place).read_all<PackSection>(header.section_count);
}

Pack::Sections Pack::find_sections(std::span<const PackSection> table) {
  const std::string place = name() + ": section table";
  constexpr std::array types = {geometry_type, skeleton_type, sub_hierarchies_type};
  const auto name_of = [&](size_t type) { return std::string_view(types[type].data(), types[type].size()); };
  Sections found{};
  const auto take_once = [&](const std::array<char, 4>& type, const PackSection& section,
                             std::optional<PackSection>& into) {
    if (section.type != type) return;
    if (into) fail(place, "names two {} sections", std::string_view(type.data(), type.size()));
    into = section;
  };
  for (const PackSection& section : table) {  // sections of other types are left to programs that know them
    take_once(objects_type, section, objects_);
    take_once(options_type, section, options_);
    take_once(seen_from_outside_type, section, seen_from_outside_);
    take_once(closed_surfaces_type, section, closed_surfaces_);
    take_once(materials_type, section, materials_);
    take_once(texels_type, section, texels_);
    take_once(motion_type, section, motion_);
    take_once(geo_place_type, section, geo_place_);
    for (size_t type = 0; type < types.size(); ++type) {
      if (section.type != types[type]) continue;
      if (found[type]) fail(place, "names two {} sections", name_of(type));
      const bool is_geometry = section.type == geometry_type;
      const uint32_t oldest = is_geometry ? geometry_version : 1;
      const uint32_t newest = is_geometry ? lit_geometry_version : 1;
      if (section.version > newest) fail(place, "holds a section {} of a newer version", name_of(type));
      if (section.version < oldest) {
        fail(place, "holds a section {} of an earlier version: build the pack again", name_of(type));
      }
      found[type] = &section;
    }
  }
  for (size_t type = 0; type < types.size(); ++type) {
    const bool wanted = types[type] != sub_hierarchies_type || format_version_ != pack_format_version;
    if (wanted && !found[type]) fail(place, "names no {} section", name_of(type));
    if (!wanted && found[type]) {
      fail(place, "names a {} section, which packs of format version {} do not have", name_of(type),
           format_version_);
    }
  }
  return found;
}

std::vector<std::byte> Pack::read_section(const PackSection& section, const std::string& place) const {
  auto bytes = read_bytes(section.offset, section.size, place);
  if (hash_bytes(bytes) != section.checksum) {
    fail(place, "byte {}: the checksum does not match: the pack is damaged, build it again", section.offset);
  }
  return bytes;
}

void Pack::check_version(const PackSection& section, uint32_t known, const std::string& place) {
  if (section.version == known) return;
  fail(place, "is of version {}, this program reads {}: {}", section.version, known,
       section.version < known ? "build the pack again" : "a newer program wrote it");
}

PackOptions Pack::read_options() const {
  if (!options_) return {};
  const std::string place = name() + ": section OPTS";
  check_version(*options_, options_version, place);
  if (options_->size > max_pack_options_bytes)
    fail(place, "has {} bytes, more than {}", options_->size, max_pack_options_bytes);
  return decode_pack_options(read_section(*options_, place), place);
}

PackObjects Pack::read_objects() const {
  if (!objects_) return PackObjects(skeleton_);
  const std::string place = name() + ": section OBJS";
  check_version(*objects_, objects_version, place);
  return {decode_objects(read_section(*objects_, place), place), skeleton_, place};
}

Chunk Pack::read_chunk(uint32_t chunk) const {
  return decode_chunk_in(read_chunk_bytes(chunk, chunk), chunk, chunk);
}

std::vector<Texel> Pack::read_texels(uint32_t texture, uint32_t level) const {
  const Texture& of = skeleton_.textures.at(texture);
  const TextureLevel& stored = of.levels.at(level);
  const std::string place = fmt::format("{}: section TEXL: texture {} level {}", name(), texture, level);
  const std::vector<std::byte> bytes = read_bytes(texels_->offset + stored.offset, stored.size, place);
  if (hash_bytes(bytes) != stored.checksum) {
    fail(place, "byte {}: the checksum does not match: the pack is damaged, build it again",
         texels_->offset + stored.offset);
  }
  return decode_texels(bytes, side_at_level(of.width, level), side_at_level(of.height, level), place);
}

std::vector<std::byte> Pack::read_chunk_bytes(uint32_t first, uint32_t last) const {
  const ChunkInfo &from = skeleton_.chunks.at(first), &to = skeleton_.chunks.at(last);
  const std::string place = first == last
                                ? fmt::format("{}: section GEOM: chunk {}", name(), first)
                                : fmt::format("{}: section GEOM: chunks {} to {}", name(), first, last);
  return read_bytes(geometry_offset_ + from.offset, to.offset + to.size - from.offset, place);
}

Chunk Pack::decode_chunk_in(std::span<const std::byte> all, uint32_t first, uint32_t chunk) const {
  const ChunkInfo& info = skeleton_.chunks.at(chunk);
  const std::string place = fmt::format("{}: section GEOM: chunk {}", name(), chunk);
  const std::span<const std::byte> bytes =
      all.subspan(info.offset - skeleton_.chunks.at(first).offset, info.size);
  if (hash_bytes(bytes) != info.checksum) {
    fail(place, "byte {}: the checksum does not match: the pack is damaged, build it again",
         geometry_offset_ + info.offset);
  }
  Chunk decoded = decode_chunk(bytes, info, skeleton_.pieces_of(chunk), skeleton_.palette.size(), place);
  const bool in_layers =
      std::ranges::any_of(decoded.vertices, [](const ChunkVertex& vertex) { return vertex.layer > 0; });
  if (in_layers && !has_layers(skeleton_.effects))
    fail(place, "has layers, which the effects of section SKEL do not name");
  if (!decoded.coordinates.empty() && skeleton_.materials.empty())
    fail(place, "has texture coordinates, where the pack has no section MATL");
  return decoded;
}

}  // namespace triptych
