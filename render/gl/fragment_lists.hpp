// What is transparent over a framebuffer: lists of fragments, pixel by pixel, in the device's memory (Yang,
// Hensley, Grün and Thibieroz, Real-time concurrent linked list construction on the GPU, 2010).
#pragma once

#include "render/gl/framebuffer.hpp"
#include "render/gl/objects.hpp"
#include "visibility/visible_set.hpp"

#include <cstdint>
#include <functional>
#include <optional>

namespace triptych {

/// Collects the fragments of one plane at a time, and makes its veil of them: of each pixel what they add,
/// and by how much they let shine through what lies behind.
class FragmentLists {
 public:
  /// cap_bytes: of lists in device memory, at most: areas with more fragments are made in parts.
  explicit FragmentLists(uint64_t cap_bytes = uint64_t{256} << 20) : cap_bytes_(cap_bytes) {}

  /// Of planes that are this large.
  void begin(const Framebuffer& planes);
  /// Makes the veil of a plane. draw(): called one or more times, draws everything that is transparent with
  /// programs of transparent_fragment_shader(), without a depth test. owners: gets the drawables of all
  /// fragments, some of them several times; may be null. Error (place: OpenGL) where one pixel alone has more
  /// fragments than lists have room for.
  void make(const Framebuffer& planes, uint32_t plane, const std::function<void()>& draw, VisibleSet* owners);

  /// Layers are planes: what they add, and in alpha what they let through.
  const GlTextureArray& veils() const { return target_->veils; }
  uint64_t fragments() const { return fragments_; }  ///< since begin()
  uint64_t splits() const { return splits_; }        ///< areas that were made in parts since begin()

 private:
  struct Area {
    int left, bottom, width, height;
  };
  struct Target {
    int width, height;
    uint32_t planes;
    GlTexture heads = {};
    GlTextureArray veils = {};
    GlFramebuffer framebuffer = {}, nothing = {};
  };
  void make_area(const Area& area, const std::function<void()>& draw, VisibleSet* owners);
  uint32_t draw_area(const Area& area, const std::function<void()>& draw);
  void make_room(uint64_t fragments);
  void collect(uint32_t count, VisibleSet& owners) const;
  void compose();

  uint64_t cap_bytes_;
  std::optional<Target> target_;
  GlBuffer nodes_;
  uint64_t capacity_ = 0, most_ = 0;  ///< fragments
  std::optional<GlProgram> compose_;
  GlVertexArray vertex_array_;
  uint64_t fragments_ = 0, splits_ = 0;
};

}  // namespace triptych
