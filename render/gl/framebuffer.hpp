// A framebuffer: colours or drawable ids, and 32-bit float depth.
#pragma once

#include "render/gl/objects.hpp"
#include "visibility/frame_target.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// What the stencil holds where no winding number was counted, so that they may be negative.
inline constexpr GLint winding_zero = 128;

/// What a framebuffer has beyond one plane of colours or ids.
struct FramebufferLayout {
  uint32_t samples = 1;  ///< planes of each, one for each sample of a pixel
  bool normals = false;  ///< of faces, beside colours; for edges
  bool stencil = false;  ///< beside depth: winding numbers, for cut surfaces
  bool operator==(const FramebufferLayout&) const = default;
};

/// A framebuffer of width × height pixels. Rows of read-back pictures go from bottom to top, as in OpenGL.
/// What is read, written or shown is the first plane, where no other is named.
class Framebuffer {
 public:
  Framebuffer(TargetKind kind, int width, int height, const FramebufferLayout& layout = {});
  /// Binds a plane and its viewport.
  void bind(uint32_t plane = 0) const;
  /// All planes: depth to 0 (infinitely far), colour to the background, items to 0.
  void clear() const;
  /// width × height × RGBA bytes; TargetKind::color or color_and_item.
  std::vector<uint8_t> read_colors() const;
  /// Replaces them; RGBA, of a target with colours.
  void write_colors(std::span<const uint8_t> colors);
  /// width × height of drawable id + 1, 0 where nothing is, of a plane; TargetKind::item or color_and_item.
  std::vector<uint32_t> read_items(uint32_t plane = 0) const;
  /// width × height of reversed depth.
  std::vector<float> read_depths() const;
  /// Copies the colours into the context's window of window_width × window_height pixels: as much as fits;
  /// the rest is background.
  void copy_to_window(int window_width, int window_height) const;
  TargetKind kind() const { return kind_; }
  const FramebufferLayout& layout() const { return layout_; }
  bool has_colors() const { return kind_ == TargetKind::color || kind_ == TargetKind::color_and_item; }
  bool has_items() const { return kind_ == TargetKind::item || kind_ == TargetKind::color_and_item; }
  int width() const { return width_; }
  int height() const { return height_; }

  // Layers are planes.
  const GlTextureArray& colors() const { return color_; }
  const GlTextureArray& depths() const { return depth_; }
  /// Half of each normal and a half; without meaning where nothing is.
  const GlTextureArray& normals() const { return normal_; }

 private:
  void attach(const GlTextureArray& texture, GLenum attachment, GLenum format);

  TargetKind kind_;
  int width_, height_;
  FramebufferLayout layout_;
  GlTextureArray color_, item_, normal_, depth_;
  std::vector<GlFramebuffer> planes_;
};

}  // namespace triptych
