// Textures in device memory: those that what was drawn last calls for, within a cap.
#pragma once

#include "render/gl/device_space.hpp"
#include "render/gl/objects.hpp"
#include "residency/residency.hpp"
#include "scene/geometry_use.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// The texels of textures in one buffer, and a table of where they lie, for shaders
/// (texture_shader_source()). Nothing is made before a texture is required.
class TextureBuffer {
 public:
  TextureBuffer(const Skeleton& skeleton, Residency& residency)
      : skeleton_(skeleton), residency_(residency) {}

  /// What only earlier views needed may go from now on.
  void begin_view();
  /// Reads and uploads the texture, if it is not there, without its finest levels where these have no room;
  /// how many bytes. Error (pack, texture) for damage.
  uint64_t require(uint32_t texture);
  void set_cap(uint64_t bytes) { cap_ = bytes; }
  void set_missing(const MissingChunks& missing) { missing_ = missing; }
  void bind() const;
  TextureUse use() const;

 private:
  /// As the shaders have it: of the finest level that is there.
  struct Record {
    uint32_t width, height, levels;
    uint32_t
        first;  ///< word of the buffer at which the places of its levels begin, and behind them its texels
  };
  struct Held {
    uint64_t view = 0, offset = 0, bytes = 0;
    uint32_t finest = 0;  ///< level that is there
    bool is_held() const { return bytes > 0; }
  };
  void drop(Held& held);
  std::optional<uint64_t> place(uint64_t bytes);
  bool drop_oldest();
  void grow(uint64_t bytes);

  const Skeleton& skeleton_;
  Residency& residency_;
  uint64_t view_ = 1, cap_ = no_cap, bytes_ = 0, largest_ = 0;
  MissingChunks missing_;
  DeviceSpace space_;
  GlBuffer texels_, records_;
  std::vector<Held> held_;
  TextureUse use_;
  uint64_t wanted_bytes_ = 0;  ///< of what the view needs, with all levels
  bool shows_coarser_ = false;
};

}  // namespace triptych
