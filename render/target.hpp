// What is drawn into: colour or item ids, and 32-bit float depth.
#pragma once

#include <cstdint>
#include <vector>

#include "render/gl_objects.hpp"

namespace triptych {

enum class TargetKind { color, item, depth_only };

/// A framebuffer of width × height pixels. Rows of read-back pictures go from bottom to top, as OpenGL has them.
class Target {
 public:
  Target(TargetKind kind, int width, int height);
  /// Binds the framebuffer and its viewport.
  void bind() const;
  /// Depth to 0 (infinitely far), colour to the background, items to 0.
  void clear() const;
  /// width × height × RGBA bytes; TargetKind::color only.
  std::vector<uint8_t> read_colors() const;
  /// width × height of drawable id + 1, 0 where nothing is; TargetKind::item only.
  std::vector<uint32_t> read_items() const;
  /// width × height of reversed depth.
  std::vector<float> read_depths() const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  TargetKind kind_;
  int width_, height_;
  GlTexture color_, depth_;
  GlFramebuffer framebuffer_;
};

}  // namespace triptych
