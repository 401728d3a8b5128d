#include "render/gl/raster_probe.hpp"

#include "render/draw_list.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/rectangle_state.hpp"
#include "render/gl/shaders.hpp"
#include "render/gl/vertex_layout.hpp"
#include "scene/chunk.hpp"

#include <random>

namespace triptych {

namespace {

const std::string bare_vertex_shader = R"(#version 450
layout(std430, binding = 0) readonly buffer Vertices { vec4 vertices[]; };
void main() { gl_Position = vertices[gl_VertexID]; }
)";
const std::string counting_fragment_shader = R"(#version 450
layout(location = 0) out float count;
void main() { count = 1.0; }
)";

}  // namespace

void append_rectangle(std::vector<ProbeVertex>& vertices, float left, float bottom, float right, float top,
                      float depth) {
  const ProbeVertex a{left, bottom, depth}, b{right, bottom, depth}, c{right, top, depth},
      d{left, top, depth};
  vertices.insert(vertices.end(), {a, b, c, a, c, d});
}

RasterProbe::RasterProbe(int width, int height)
    : width_(width),
      height_(height),
      triangles_(make_program("probe", bare_vertex_shader, counting_fragment_shader)),
      queries_(make_program("probe of queries", rectangle_vertex_shader(), query_fragment_shader(false))),
      storage_(make_program("probe of storage", rectangle_vertex_shader(), storage_fragment_shader(false))) {
  glTextureStorage2D(count_, 1, GL_R32F, width, height);
  glTextureStorage2D(depth_, 1, GL_DEPTH_COMPONENT32F, width, height);
  glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, count_, 0);
  glNamedFramebufferTexture(framebuffer_, GL_DEPTH_ATTACHMENT, depth_, 0);
}

void RasterProbe::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  glViewport(0, 0, width_, height_);
  glBindVertexArray(vertex_array_);
}

void RasterProbe::draw(const std::vector<ProbeVertex>& vertices) {
  bind();
  vertices_.upload(std::span<const ProbeVertex>(vertices));
  glUseProgram(triangles_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, probe_binding, vertices_);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()));
}

std::vector<float> RasterProbe::read(GLenum format) const {
  std::vector<float> values(static_cast<size_t>(width_) * static_cast<size_t>(height_));
  glReadPixels(0, 0, width_, height_, format, GL_FLOAT, values.data());
  return values;
}

std::vector<float> RasterProbe::count_fragments(const std::vector<ProbeVertex>& vertices) {
  const float nothing[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, nothing);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  draw(vertices);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  return read(GL_RED);
}

std::vector<float> RasterProbe::depths(const std::vector<ProbeVertex>& vertices) {
  const float far_away = 0;
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glClearNamedFramebufferfv(framebuffer_, GL_DEPTH, 0, &far_away);
  draw(vertices);
  return read(GL_DEPTH_COMPONENT);
}

uint64_t RasterProbe::fragments_that_pass_again(const std::vector<ProbeVertex>& vertices) {
  const std::vector<float> before = depths(vertices);
  const float nothing[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(framebuffer_, GL_COLOR, 0, nothing);
  draw(vertices);
  uint64_t passed = 0;
  for (const float count : read(GL_RED)) passed += count > 0.5f;
  return passed;
}

std::vector<uint8_t> RasterProbe::test_by_queries(std::span<const ScreenRectangle> rectangles) {
  bind();
  rectangles_.upload(rectangles);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, rectangles_binding, rectangles_);
  const RectangleState state(queries_, width_, height_);
  std::vector<GLuint> names(rectangles.size());
  glCreateQueries(GL_ANY_SAMPLES_PASSED, static_cast<GLsizei>(names.size()), names.data());
  for (size_t i = 0; i < names.size(); ++i) {
    glBeginQuery(GL_ANY_SAMPLES_PASSED, names[i]);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, 4, static_cast<GLuint>(4 * i));
    glEndQuery(GL_ANY_SAMPLES_PASSED);
  }
  std::vector<uint8_t> answers;
  for (const GLuint name : names) {
    GLuint passed = GL_FALSE;
    glGetQueryObjectuiv(name, GL_QUERY_RESULT, &passed);
    answers.push_back(passed != GL_FALSE);
  }
  glDeleteQueries(static_cast<GLsizei>(names.size()), names.data());
  return answers;
}

std::vector<uint8_t> RasterProbe::test_by_storage(std::span<const ScreenRectangle> rectangles) {
  bind();
  rectangles_.upload(rectangles);
  std::vector<uint32_t> answers(rectangles.size(), 0);
  answers_.upload(std::span<const uint32_t>(answers));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, rectangles_binding, rectangles_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, answers_binding, answers_);
  const RectangleState state(storage_, width_, height_);
  glDrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(4 * answers.size()), 0);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(answers_, 0, static_cast<GLsizeiptr>(answers.size() * sizeof(uint32_t)),
                          answers.data());
  return {answers.begin(), answers.end()};
}

double passes_that_disagree() {
  constexpr int side = 256;
  std::mt19937 random(3);
  const auto integer = [&](int below) { return static_cast<int>(random() % static_cast<uint32_t>(below)); };
  std::vector<ChunkVertex> vertices;
  for (int i = 0; i < 400; ++i) {
    const glm::ivec3 at(integer(1 << 20) - (1 << 19), integer(1 << 20) - (1 << 19),
                        -(1 << 18) - integer(1 << 20));
    for (int corner = 0; corner < 3; ++corner)
      vertices.push_back({at + glm::ivec3(integer(1 << 17), integer(1 << 17), integer(1 << 17)), 0});
  }
  const DrawRecord record{.rows = {{0x1.234p-20f, 0x1.5p-26f, 0x1.7p-27f, 0.001f},
                                   {-0x1.5p-26f, 0x1.1p-20f, 0x1.3p-25f, 0.002f},
                                   {0x1.1p-27f, -0x1.3p-25f, 0x1.2p-20f, -0.003f}},
                          .cell = {17, -29, 5},
                          .item = 0,
                          .first_bound = 0,
                          .cut = 0};
  const PixelDepthBound bound{.x = {}, .y = {}, .at = glm::vec4(1)};
  const glm::vec4 white(1);
  GlVertexArray vertex_array;
  StreamBuffer positions, records, bounds, palette;
  positions.upload(std::span<const ChunkVertex>(vertices));
  records.upload(std::span(&record, 1));
  bounds.upload(std::span(&bound, 1));
  palette.upload(std::span(&white, 1));
  describe_vertices(vertex_array);
  glVertexArrayVertexBuffer(vertex_array, vertices_stream, positions, 0, sizeof(ChunkVertex));
  glVertexArrayVertexBuffer(vertex_array, records_stream, records, 0, sizeof(DrawRecord));

  const Framebuffer target(TargetKind::color_and_item, side, side);
  const auto draw = [&](const std::string& fragments) {
    const GlProgram program =
        make_program("probe of passes", geometry_vertex_shader(Projection::perspective, {}), fragments);
    glUseProgram(program);
    glUniform4f(glGetUniformLocation(program, "frustum"), 1.37f, 1.11f, 0.01f, 0.02f);
    glUniform2f(glGetUniformLocation(program, "depth"), 0.013f, 0);
    target.bind();
    glBindVertexArray(vertex_array);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bounds_binding, bounds);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, palette_binding, palette);
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()), 1, 0);
  };
  target.clear();
  glDepthFunc(GL_GREATER);
  draw(depth_fragment_shader({}));
  const std::vector<float> depths = target.read_depths();
  double covered = 0, met = 0;
  for (const float depth : depths) covered += depth > 0;
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  draw(color_and_item_fragment_shader({}));
  glDepthMask(GL_TRUE);
  for (const uint32_t item : target.read_items()) met += item == 1;
  return covered > 0 ? covered - met : 1;  // nothing drawn proves nothing
}

}  // namespace triptych
