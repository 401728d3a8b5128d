// Draws what a raster certificate measures: plain triangles in clip space, and rectangles under test.
#pragma once

#include "render/gl/objects.hpp"
#include "visibility/screen_bounds.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A position in clip space.
struct ProbeVertex {
  float x = 0, y = 0, z = 0, w = 1;
};

/// Two triangles, normalised device coordinates.
void append_rectangle(std::vector<ProbeVertex>& vertices, float left, float bottom, float right, float top,
                      float depth);

/// A target of float counts and 32-bit float depth. Every three vertices are a triangle; rows of pictures go
/// from bottom to top.
class RasterProbe {
 public:
  RasterProbe(int width, int height);

  /// How often each pixel is drawn, without a depth test.
  std::vector<float> count_fragments(const std::vector<ProbeVertex>& vertices);
  /// The depth buffer after drawing the triangles into an empty one, the nearest in front.
  std::vector<float> depths(const std::vector<ProbeVertex>& vertices);
  /// Draws the triangles again over their own depth, with a strict test: how many fragments pass.
  uint64_t fragments_that_pass_again(const std::vector<ProbeVertex>& vertices);
  /// 1 where a rectangle is at or in front of the depth somewhere.
  std::vector<uint8_t> test_by_queries(std::span<const ScreenRectangle> rectangles);
  std::vector<uint8_t> test_by_storage(std::span<const ScreenRectangle> rectangles);

 private:
  void bind() const;
  void draw(const std::vector<ProbeVertex>& vertices);
  std::vector<float> read(GLenum format) const;

  int width_, height_;
  GlTexture count_, depth_;
  GlFramebuffer framebuffer_;
  GlProgram triangles_, queries_, storage_;
  GlVertexArray vertex_array_;
  StreamBuffer vertices_, rectangles_, answers_;
};

/// Draws random triangles with the product's own vertex stage in a depth pass, then in each other pass where
/// depths are equal: how many fragments of the first picture the others miss.
double passes_that_disagree();

}  // namespace triptych
