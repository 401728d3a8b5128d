#include "render/flat_model_pass.hpp"

#include "base/error.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/resolve_pass.hpp"
#include "render/gl/shaders.hpp"
#include "render/gl/view_uniforms.hpp"

#include <cstddef>
#include <limits>
#include <optional>

namespace triptych {

namespace {

template <typename Value>
void store(GLuint buffer, const std::vector<Value>& values) {
  if (values.empty()) return;
  glNamedBufferStorage(buffer, static_cast<GLsizeiptr>(values.size() * sizeof(Value)), values.data(), 0);
}

class GlFlatModelPass final : public FlatModelPass {
 public:
  GlFlatModelPass(const FlatModel& model, int width, int height)
      : origin_(model.origin),
        unit_(model.unit),
        index_count_(static_cast<GLsizei>(model.indices.size())),
        picture_(TargetKind::color, width, height) {
    store(vertices_, model.vertices);
    store(indices_, model.indices);
    check_gl("device memory");
    glVertexArrayAttribFormat(vertex_array_, 0, 3, GL_FLOAT, GL_FALSE, offsetof(FlatVertex, position));
    glVertexArrayAttribFormat(vertex_array_, 1, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(FlatVertex, color));
    for (GLuint attribute = 0; attribute < 2; ++attribute) {
      glVertexArrayAttribBinding(vertex_array_, attribute, 0);
      glEnableVertexArrayAttrib(vertex_array_, attribute);
    }
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(FlatVertex));
    glVertexArrayElementBuffer(vertex_array_, indices_);
  }

  void draw(const FrameView& view) override {
    const Pass& pass = pass_of(view.view().camera.projection, !view.section_space.keeps_all());
    glUseProgram(pass.program);
    const glm::mat3 linear(view.rotation * (unit_ / view.clip.unit));
    const glm::vec3 shift(view.rotation * ((origin_ - view.clip.reference) / view.clip.unit));
    glUniformMatrix3fv(pass.to_eye, 1, GL_FALSE, &linear[0][0]);
    glUniform3f(pass.shift, shift.x, shift.y, shift.z);
    const Framebuffer& planes = planes_of(view.state.samples);
    planes.clear();
    glBindVertexArray(vertex_array_);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    const auto places = sample_places(view.state.samples);
    for (uint32_t plane = 0; plane < places.size(); ++plane) {
      planes.bind(plane);
      pass.uniforms.set(view, places[plane]);
      glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
    }
    if (places.size() > 1) resolve_.draw(view, planes, nullptr, picture_);
    glFinish();
  }

  std::vector<uint8_t> read_colors() const override { return picture_.read_colors(); }

 private:
  struct Pass {
    Pass(Projection projection, bool sections)
        : program(make_program("whole model", flat_model_vertex_shader(projection),
                               flat_model_fragment_shader(sections))),
          uniforms(program),
          to_eye(glGetUniformLocation(program, "to_eye")),
          shift(glGetUniformLocation(program, "shift")) {}
    GlProgram program;
    ViewUniforms uniforms;
    GLint to_eye, shift;
  };

  const Pass& pass_of(Projection projection, bool sections) {
    std::optional<Pass>& pass = passes_[sections ? 1 : 0][static_cast<size_t>(projection)];
    if (!pass) pass.emplace(projection, sections);
    return *pass;
  }

  /// One for each sample; of a single one the picture itself.
  const Framebuffer& planes_of(uint32_t samples) {
    if (samples == 1) return picture_;
    const FramebufferLayout wanted{.samples = samples};
    if (!planes_ || !(planes_->layout() == wanted))
      planes_.emplace(TargetKind::color, picture_.width(), picture_.height(), wanted);
    return *planes_;
  }

  glm::dvec3 origin_;
  double unit_;
  GLsizei index_count_;
  Framebuffer picture_;
  std::optional<Framebuffer> planes_;
  ResolvePass resolve_;
  GlBuffer vertices_, indices_;
  GlVertexArray vertex_array_;
  std::optional<Pass> passes_[2][2];  ///< by sections and projection
};

}  // namespace

std::unique_ptr<FlatModelPass> make_gl_flat_model_pass(const FlatModel& model, int width, int height) {
  constexpr size_t limit = std::numeric_limits<GLsizei>::max();
  if (model.indices.size() > limit)
    fail("OpenGL", "{} triangles are more than one draw can take", model.triangle_count());
  return std::make_unique<GlFlatModelPass>(model, width, height);
}

}  // namespace triptych
