// Occlusion tests on the graphics card: queries, or one batched draw that marks a storage buffer.
#pragma once

#include "render/renderer.hpp"
#include "visibility/occlusion_tester.hpp"

#include <vector>

namespace triptych {

/// How rectangles are tested. Both give the same answers; which is faster depends on the machine.
enum class TestKind {
  queries,  ///< one GL_ANY_SAMPLES_PASSED occlusion query a rectangle
  storage,  ///< all rectangles in one instanced draw; fragments that pass mark their slot
};

/// An occlusion representation in a depth-only target of its own.
class GlOcclusionTester : public OcclusionTester {
 public:
  GlOcclusionTester(Renderer& renderer, int width, int height, TestKind kind);

  /// Empties the representation, for this view.
  void begin(const View& view);
  void draw(std::span<const DrawableId> drawables) override;
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
            std::span<uint8_t> visible) override;
  const Target& target() const { return target_; }

 private:
  void test_by_queries(std::span<const uint32_t> ends, std::span<uint8_t> visible);
  void test_by_storage(std::span<const uint32_t> ends, std::span<uint8_t> visible);

  Renderer& renderer_;
  Target target_;
  TestKind kind_;
  View view_;
  GlProgram program_;
  GlVertexArray vertex_array_;
  StreamBuffer rectangles_, answers_;
  std::vector<GLuint> queries_;

 public:
  ~GlOcclusionTester() override;
};

}  // namespace triptych
