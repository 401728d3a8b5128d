#include "render/gl/rectangle_test.hpp"

#include "render/gl/rectangle_state.hpp"
#include "render/gl/shaders.hpp"

#include <algorithm>

namespace triptych {

RectangleTest::~RectangleTest() {
  if (!queries_.empty()) glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

void RectangleTest::test(const Framebuffer& framebuffer, GLenum comparison,
                         std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                         std::span<uint8_t> visible) {
  if (rectangles.empty()) return;
  if (!program_) {
    program_ = make_program("occlusion test", rectangle_vertex_shader(),
                            kind_ == TestKind::queries ? query_fragment_shader() : storage_fragment_shader());
  }
  rectangles_.upload(rectangles);
  framebuffer.bind();
  glBindVertexArray(vertex_array_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, rectangles_binding, rectangles_);
  const RectangleState state(*program_, framebuffer.width(), framebuffer.height(), comparison);
  if (kind_ == TestKind::queries) {
    test_by_queries(ends, visible);
  } else {
    test_by_storage(ends, visible);
  }
}

void RectangleTest::test_by_queries(std::span<const uint32_t> ends, std::span<uint8_t> visible) {
  const size_t count = ends.size();
  if (queries_.size() < count) {
    const size_t before = queries_.size();
    queries_.resize(count);
    glCreateQueries(GL_ANY_SAMPLES_PASSED, static_cast<GLsizei>(count - before), queries_.data() + before);
  }
  constexpr size_t flush_every = 500;  // some drivers answer late or spuriously where thousands are in flight
  for (size_t i = 0; i < count; ++i) {
    const uint32_t first = i == 0 ? 0 : ends[i - 1];
    glBeginQuery(GL_ANY_SAMPLES_PASSED, queries_[i]);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(4 * (ends[i] - first)),
                                      4 * first);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    if (i % flush_every == flush_every - 1) glFlush();
  }
  for (size_t i = 0; i < count; ++i) {
    GLuint passed = GL_TRUE;
    glGetQueryObjectuiv(queries_[i], GL_QUERY_RESULT, &passed);
    visible[i] = passed != GL_FALSE;
  }
}

void RectangleTest::test_by_storage(std::span<const uint32_t> ends, std::span<uint8_t> visible) {
  const size_t count = ends.back();
  answers_.assign(count, 0);
  answer_buffer_.upload(std::span<const uint32_t>(answers_));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, answers_binding, answer_buffer_);
  glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(4 * count), 0);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(answer_buffer_, 0, static_cast<GLsizeiptr>(count * sizeof(uint32_t)),
                          answers_.data());
  auto first = answers_.begin();
  for (size_t i = 0; i < ends.size(); ++i) {
    const auto end = answers_.begin() + ends[i];
    visible[i] = std::any_of(first, end, [](uint32_t answer) { return answer != 0; });
    first = end;
  }
}

}  // namespace triptych
