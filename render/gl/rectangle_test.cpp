#include "render/gl/rectangle_test.hpp"

#include "render/gl/rectangle_state.hpp"
#include "render/gl/shaders.hpp"

#include <numeric>

namespace triptych {

RectangleTest::~RectangleTest() {
  for (const Way* way : {&any_, &counting_}) {
    if (!way->queries.empty())
      glDeleteQueries(static_cast<GLsizei>(way->queries.size()), way->queries.data());
  }
}

const GlProgram& RectangleTest::program(bool counting) {
  std::optional<GlProgram>& program = (counting ? counting_ : any_).program;
  if (!program) {
    program = make_program(
        counting ? "occlusion test that counts" : "occlusion test", rectangle_vertex_shader(),
        kind_ == TestKind::queries ? query_fragment_shader(counting) : storage_fragment_shader(counting));
  }
  return *program;
}

void RectangleTest::test(const Framebuffer& framebuffer, uint32_t plane, GLenum comparison,
                         std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends,
                         uint32_t min_pixels, std::span<uint8_t> visible) {
  if (rectangles.empty()) return;
  rectangles_.upload(rectangles);
  framebuffer.bind(plane);
  glBindVertexArray(vertex_array_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, rectangles_binding, rectangles_);
  const RectangleState state(program(min_pixels > 1), framebuffer.width(), framebuffer.height(), comparison);
  if (kind_ == TestKind::queries) {
    test_by_queries(ends, min_pixels, visible);
  } else {
    test_by_storage(ends, min_pixels, visible);
  }
}

void RectangleTest::test_by_queries(std::span<const uint32_t> ends, uint32_t min_pixels,
                                    std::span<uint8_t> visible) {
  const bool counting = min_pixels > 1;
  const GLenum target = counting ? GL_SAMPLES_PASSED : GL_ANY_SAMPLES_PASSED;
  std::vector<GLuint>& queries = (counting ? counting_ : any_).queries;
  const size_t count = ends.size();
  if (queries.size() < count) {
    const size_t before = queries.size();
    queries.resize(count);
    glCreateQueries(target, static_cast<GLsizei>(count - before), queries.data() + before);
  }
  constexpr size_t flush_every = 500;  // some drivers answer late or spuriously where thousands are in flight
  for (size_t i = 0; i < count; ++i) {
    const uint32_t first = i == 0 ? 0 : ends[i - 1];
    glBeginQuery(target, queries[i]);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(4 * (ends[i] - first)),
                                      4 * first);
    glEndQuery(target);
    if (i % flush_every == flush_every - 1) glFlush();
  }
  for (size_t i = 0; i < count; ++i) {
    GLuint64 passed = min_pixels;  // visible, where there is no answer
    glGetQueryObjectui64v(queries[i], GL_QUERY_RESULT, &passed);
    visible[i] = passed >= min_pixels;
  }
}

void RectangleTest::test_by_storage(std::span<const uint32_t> ends, uint32_t min_pixels,
                                    std::span<uint8_t> visible) {
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
    visible[i] = std::accumulate(first, end, uint64_t{0}) >= min_pixels;
    first = end;
  }
}

}  // namespace triptych
