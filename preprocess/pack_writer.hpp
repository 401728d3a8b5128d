// Packs are written here, chunk by chunk, and read in scene/pack.hpp.
#pragma once

#include "base/file.hpp"
#include "base/record.hpp"
#include "base/spool_file.hpp"
#include "scene/chunk.hpp"
#include "scene/pack_options.hpp"
#include "scene/sub_hierarchy.hpp"
#include "scene/transparency.hpp"

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace triptych {

/// A chunk that waits for its turn to be written: threads encode, one writes in a fixed order.
struct EncodedChunk {
  EncodedChunk() = default;
  /// As encode_chunk().
  explicit EncodedChunk(const Chunk& chunk, std::span<const uint32_t> runs = {}, Palette palette = {});

  std::vector<std::byte> bytes;
  uint32_t vertices = 0, triangles = 0;
  LatticeBox box;
  std::vector<LatticeBox> pieces;  ///< Chunk::pieces()
  bool seen_from_outside = false;  ///< Skeleton::seen_from_outside
  ChunkNormals normals = ChunkNormals::none;
};
template <>
inline constexpr auto record_members<EncodedChunk> = std::tuple(&EncodedChunk::bytes, &EncodedChunk::vertices,
                                                                &EncodedChunk::triangles, &EncodedChunk::box,
                                                                &EncodedChunk::pieces,
                                                                &EncodedChunk::seen_from_outside,
                                                                &EncodedChunk::normals);

/// Which kinds of normals chunks have.
struct NormalsUsed {
  bool of_levels = false, of_files = false;
  void add(ChunkNormals normals) {
    of_levels = of_levels || normals == ChunkNormals::of_levels;
    of_files = of_files || normals == ChunkNormals::of_files;
  }
  void add(const NormalsUsed& other) {
    of_levels = of_levels || other.of_levels;
    of_files = of_files || other.of_files;
  }
};

/// Writes chunks as they come, then the skeleton; the file does not appear under its name before finish().
class PackWriter {
 public:
  explicit PackWriter(const std::filesystem::path& file);
  /// What an earlier process had written at its last flush(); 0 for new files.
  struct Kept {
    KeptBytes pack, pieces;
  };
  /// Writes under the name `partial` until then, and boxes of pieces to a file `partial`.pieces, which the
  /// caller removes. Register chunks that are kept with adopt().
  PackWriter(const std::filesystem::path& file, const std::filesystem::path& partial, Kept kept);
  /// Encodes and appends the chunk; returns its index for Placement::chunk. Records the chunk's box and
  /// counts.
  uint32_t add_chunk(const Chunk& chunk, uint32_t lattice);
  /// Appends a chunk that was encoded already; for builds on many threads.
  uint32_t add_chunk(const EncodedChunk& chunk, uint32_t lattice);
  /// Registers the next of the chunks that are kept, which of them are made to be seen from outside, and what
  /// normals they have.
  void adopt(std::span<const ChunkInfo> chunks, std::span<const uint8_t> seen_from_outside,
             const NormalsUsed& normals);
  const std::vector<ChunkInfo>& chunks() const { return chunks_; }
  bool seen_from_outside(uint32_t chunk) const { return seen_from_outside_[chunk]; }
  /// Makes sure that what was added survives the end of the process. Returns what another process can keep.
  Kept flush();
  /// Writes the skeleton (its chunks and pieces are the writer's own, and chunks' normals are added to its
  /// effects) and puts the file in place. Without
  /// instances the pack has the format version without sub-hierarchies. `objects`: the section OBJS
  /// (preprocess/encode_objects.hpp); `options`: what the section OPTS says. The pack has neither if they are
  /// empty. `texels`: of the skeleton's textures, if it has any.
  void finish(StoredSkeleton skeleton, std::span<const std::byte> objects = {},
              const PackOptions& options = {}, const SpoolFile* texels = nullptr);
  void finish(Skeleton skeleton) { finish(StoredSkeleton{std::move(skeleton), {}, {}}); }

 private:
  AtomicFile file_;
  std::vector<ChunkInfo> chunks_;
  std::vector<bool> seen_from_outside_;  ///< for each chunk
  NormalsUsed normals_;
  SpoolFile pieces_;  ///< LatticeBoxes: large models have too many to hold them in memory
};

}  // namespace triptych
