// Geometry in device memory: chunks of a pack, loaded when something wants to be drawn.
#pragma once

#include "render/gl_objects.hpp"
#include "scene/pack.hpp"

#include <span>
#include <vector>

namespace triptych {

/// Vertices and indices of the chunks loaded so far, in two growing buffers, and the palette.
class DeviceScene {
 public:
  explicit DeviceScene(const Pack& pack);

  /// Where a chunk lies in the buffers.
  struct Range {
    uint32_t first_index = 0, index_count = 0, base_vertex = 0;
    bool loaded() const { return index_count > 0; }
  };

  /// Loads what the drawables need and is not there. Error for a damaged chunk, or where OpenGL has no memory
  /// left.
  void require(std::span<const DrawableId> drawables);
  const Range& range(uint32_t chunk) const { return ranges_[chunk]; }

  const Pack& pack() const { return pack_; }
  const Skeleton& skeleton() const { return pack_.skeleton(); }
  /// Bytes of device memory in use.
  uint64_t device_bytes() const { return vertices_.capacity + indices_.capacity; }
  /// Binds vertex array and palette for drawing.
  void bind() const;

 private:
  struct Arena {
    GlBuffer buffer;
    uint64_t used = 0, capacity = 0;
    /// Appends; returns the offset. The buffer is replaced by a larger one when it is full.
    uint64_t append(std::span<const std::byte> bytes);
  };
  void load(uint32_t chunk);
  void attach_buffers();

  const Pack& pack_;
  std::vector<Range> ranges_;
  Arena vertices_, indices_;
  GlBuffer palette_;
  GlVertexArray vertex_array_;
};

}  // namespace triptych
