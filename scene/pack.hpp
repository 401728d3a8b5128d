// The pack: one file with the skeleton and the chunks, as a table of typed, versioned, checksummed sections.
// docs/pack-format.md has it to the byte.
#pragma once

#include "base/file.hpp"
#include "base/spool_file.hpp"
#include "scene/chunk.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace triptych {

inline constexpr uint32_t pack_format_version = 2;

/// A chunk that waits for its turn to be written: threads encode, one writes in a fixed order.
struct EncodedChunk {
  explicit EncodedChunk(const Chunk& chunk);

  std::vector<std::byte> bytes;
  uint32_t vertices = 0, triangles = 0;
  LatticeBox box;
  std::vector<LatticeBox> pieces;  ///< Chunk::pieces()
};

/// Writes chunks as they come, then the skeleton; the file appears under its name with finish() and not
/// before.
class PackWriter {
 public:
  explicit PackWriter(const std::filesystem::path& file);
  /// What an earlier process had written when it was last sure of it; nothing for new files.
  struct Kept {
    KeptBytes pack, pieces;
  };
  /// Writes under the name `partial` until then, and boxes of pieces to a file `partial`.pieces, which the
  /// caller removes. Chunks that are kept are taken over with adopt().
  PackWriter(const std::filesystem::path& file, const std::filesystem::path& partial, Kept kept);
  /// Encodes and appends the chunk; returns its index for Placement::chunk. The chunk's box and counts are
  /// taken down.
  uint32_t add_chunk(const Chunk& chunk, uint32_t lattice);
  /// Appends a chunk that was encoded already; for builds on many threads.
  uint32_t add_chunk(const EncodedChunk& chunk, uint32_t lattice);
  /// Takes over the chunks that come next.
  void adopt(std::span<const ChunkInfo> chunks);
  const std::vector<ChunkInfo>& chunks() const { return chunks_; }
  /// What was added survives the end of the process. Returns what another one can keep.
  Kept flush();
  /// Writes the skeleton (its chunks and pieces are the writer's own) and puts the file in place.
  void finish(Skeleton skeleton);

 private:
  AtomicFile file_;
  std::vector<ChunkInfo> chunks_;
  SpoolFile pieces_;  ///< LatticeBoxes: of large models too many to be held
};

/// An open pack: the skeleton in memory, chunks read on demand. Safe to read from several threads.
class Pack {
 public:
  /// Error (file, section, byte) for a file that is no pack, is cut, is damaged, or is of another version.
  explicit Pack(const std::filesystem::path& file);
  ~Pack();
  Pack(const Pack&) = delete;
  Pack& operator=(const Pack&) = delete;

  const Skeleton& skeleton() const { return skeleton_; }
  /// Reads, verifies and decodes one chunk. Error (file, chunk) for damage.
  Chunk read_chunk(uint32_t chunk) const;
  /// The same for all files with the same content: of the skeleton and every chunk's checksum.
  uint64_t content_hash() const { return content_hash_; }
  uint64_t size() const { return size_; }
  const std::string& name() const { return name_; }

 private:
  void read_table();
  std::vector<std::byte> read_bytes(uint64_t offset, uint64_t count, const std::string& place) const;

  std::string name_;
  int file_ = -1;
  uint64_t size_ = 0, geometry_offset_ = 0, geometry_size_ = 0, content_hash_ = 0;
  Skeleton skeleton_;
};

}  // namespace triptych
