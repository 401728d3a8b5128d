// Occlusion tests on the graphics card: queries, or one batched draw that marks or counts in a storage
// buffer.
#pragma once

#include "render/gl/framebuffer.hpp"
#include "render/gl_device.hpp"
#include "visibility/screen_bounds.hpp"

#include <optional>
#include <span>
#include <vector>

namespace triptych {

class RectangleTest {
 public:
  explicit RectangleTest(TestKind kind) : kind_(kind) {}
  ~RectangleTest();
  RectangleTest(const RectangleTest&) = delete;
  RectangleTest& operator=(const RectangleTest&) = delete;

  /// As OcclusionTester::test(), against the depth of a plane of the framebuffer. comparison: GL_GEQUAL is
  /// the non-strict one.
  void test(const Framebuffer& framebuffer, uint32_t plane, GLenum comparison,
            std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible);

 private:
  /// One way to ask: whether there is a pixel, or how many there are.
  struct Way {
    std::optional<GlProgram> program;  ///< made when something is first asked this way
    std::vector<GLuint> queries;
  };
  const GlProgram& program(bool counting);
  void test_by_queries(std::span<const uint32_t> ends, uint32_t min_pixels, std::span<uint8_t> visible);
  void test_by_storage(std::span<const uint32_t> ends, uint32_t min_pixels, std::span<uint8_t> visible);

  TestKind kind_;
  Way any_, counting_;
  GlVertexArray vertex_array_;
  StreamBuffer rectangles_, answer_buffer_;
  std::vector<uint32_t> answers_;
};

}  // namespace triptych
