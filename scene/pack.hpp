// The pack: one file with the skeleton and the chunks, as a table of typed, versioned, checksummed sections.
// docs/pack-format.md describes every byte.
#pragma once

#include "scene/byte_source.hpp"
#include "scene/chunk.hpp"
#include "scene/pack_format.hpp"
#include "scene/pack_options.hpp"
#include "scene/skeleton.hpp"
#include "scene/sub_hierarchy.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace triptych {

class PackObjects;

/// An open pack: the skeleton in memory, chunks read on demand. Safe to read from several threads.
class Pack {
 public:
  /// Error (file, section, byte) for a file that is not a pack, is cut short or damaged, or has another
  /// version.
  explicit Pack(const std::filesystem::path& file);
  /// The same of what is elsewhere.
  explicit Pack(std::unique_ptr<const ByteSource> source);

  /// Expanded: what is stored once in the pack is there once for each of its places (scene/expand.hpp).
  const Skeleton& skeleton() const { return skeleton_; }
  /// Reads, verifies and decodes one chunk. Error (file, chunk) for damage.
  Chunk read_chunk(uint32_t chunk) const;
  /// The bytes from the first chunk to the last one, which lies behind it, and all between, read at once.
  std::vector<std::byte> read_chunk_bytes(uint32_t first, uint32_t last) const;
  /// Verifies and decodes the chunk, out of bytes that begin with the first one. Error as read_chunk().
  Chunk decode_chunk_in(std::span<const std::byte> bytes, uint32_t first, uint32_t chunk) const;
  /// Reads, verifies and decodes a level of a texture. Error (file, texture) for damage.
  std::vector<Texel> read_texels(uint32_t texture, uint32_t level) const;
  /// Reads and verifies what the model's files say of the objects in it, which opening a pack does not touch.
  /// Error (file, section, byte) for damage, or for a section of another version. Without objects: an empty
  /// one. The pack must outlive it. scene/pack_objects.hpp has what it returns.
  PackObjects read_objects() const;
  /// Reads and verifies what the pack says of how it was built, which opening a pack does not touch. Error
  /// (file, section, byte) for damage, or for a section of another version. Empty where it says nothing.
  PackOptions read_options() const;
  /// The same for all files with the same content: a hash of the skeleton and every chunk's checksum.
  uint64_t content_hash() const { return content_hash_; }
  uint64_t size() const { return source_->size(); }
  const ByteSource& source() const { return *source_; }
  uint32_t format_version() const { return format_version_; }
  const std::string& name() const { return source_->name(); }

 private:
  /// GEOM, SKEL and SUBH, which is null in packs without sub-hierarchies.
  using Sections = std::array<const PackSection*, 3>;
  void read();
  std::vector<PackSection> read_table();
  Sections find_sections(std::span<const PackSection> table);
  void read_drawn_sections();
  StoredMotion read_motion(size_t instances) const;
  static void check_version(const PackSection& section, uint32_t known, const std::string& place);
  std::vector<std::byte> read_section(const PackSection& section, const std::string& place) const;
  std::vector<std::byte> read_bytes(uint64_t offset, uint64_t count, const std::string& place) const;

  std::unique_ptr<const ByteSource> source_;
  uint32_t format_version_ = 0;
  uint64_t geometry_offset_ = 0, geometry_size_ = 0, content_hash_ = 0;
  Skeleton skeleton_;
  std::optional<PackSection> objects_, options_, seen_from_outside_, closed_surfaces_, materials_, texels_,
      motion_, geo_place_;
};

}  // namespace triptych
