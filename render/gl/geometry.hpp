// Geometry in device memory: chunks of a pack, uploaded when they are first drawn, within a cap.
#pragma once

#include "render/draw_list.hpp"
#include "render/gl/device_space.hpp"
#include "render/gl/objects.hpp"
#include "render/gl/texture_buffer.hpp"
#include "render/gl/vertex_layout.hpp"
#include "residency/chunk_cache.hpp"
#include "residency/residency.hpp"

#include <span>
#include <vector>

namespace triptych {

/// Vertices and indices of the chunks that were drawn last, in one buffer, and the palette. Without a cap the
/// buffer grows; with one it is as large as that, or as the pack's geometry.
class Geometry {
 public:
  Geometry(const Skeleton& skeleton, Residency& residency);

  /// Chunks that only earlier views needed may go from now on.
  void begin_view();
  /// Asks the residency for the chunks that are needed and not uploaded, and uploads them, or does without
  /// them. Error for a damaged chunk, or where OpenGL has no memory left; NoRoom where the view needs more
  /// than the cap.
  void require(std::span<const DrawItem> items);
  void require(uint32_t chunk);
  std::span<const ChunkRange> ranges() const { return ranges_; }

  /// From the next view on. Of a pack with textures a share of it is theirs.
  void set_cap(uint64_t bytes) {
    const bool shared = !skeleton_.textures.empty() && bytes != no_cap;
    if (shared) textures_.set_cap(bytes / texture_share);
    cap_ = shared ? bytes - bytes / texture_share : bytes;
  }
  bool cap_changed() const { return cap_ != cache_.use().cap; }
  void set_missing(const MissingChunks& missing) {
    missing_ = missing;
    textures_.set_missing(missing);
  }
  GeometryUse use() const {
    GeometryUse use = cache_.use();
    use.textures = textures_.use();
    return use;
  }
  bool has(uint32_t chunk) const { return cache_.has(chunk); }
  bool is_damaged(uint32_t chunk) const { return cache_.is_damaged(chunk); }
  /// Uploads the textures of the chunks that are there; how many bytes.
  uint64_t require_textures(std::span<const DrawItem> items);
  /// Binds vertex array and palette for drawing, of chunks as the group says; with their normals, if the pack
  /// has any, and with materials and textures if they have places on some, or glow. records: a buffer with a
  /// DrawRecord for each base instance.
  void bind(GLuint records, const DrawGroup& group) const;

 private:
  /// Of what geometry and textures may take together.
  static constexpr uint64_t texture_share = 4;
  struct Place {
    uint64_t vertices = 0, vertex_bytes = 0, indices = 0, index_bytes = 0;
  };
  void load(uint32_t chunk);
  void drop(uint32_t chunk);
  void find_materials(const Chunk& chunk, ChunkRange& range) const;
  Place place(uint64_t vertex_bytes, uint64_t stride, uint64_t index_bytes);
  bool try_place(Place& place, uint64_t stride);
  void make_buffer(uint64_t bytes);
  void write(uint64_t offset, std::span<const std::byte> bytes);

  const Skeleton& skeleton_;
  Residency& residency_;
  std::vector<ChunkRange> ranges_;
  std::vector<Place> places_;
  ChunkCache cache_;
  MissingChunks missing_;
  uint64_t cap_ = no_cap;
  DeviceSpace space_;
  GlBuffer buffer_;
  GlBuffer palette_, materials_;
  TextureBuffer textures_;
  GlVertexArray vertex_arrays_[2][2];  ///< by whether vertices have colours, and places on textures
  bool normals_;                       ///< whether the pack has any
  bool lit_;                           ///< whether it has baked light

  VertexStreams streams(bool colored, bool textured) const { return {colored, normals_, textured, lit_}; }
};

}  // namespace triptych
