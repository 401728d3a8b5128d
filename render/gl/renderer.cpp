#include "render/gl/renderer.hpp"

#include "render/gl/shaders.hpp"

#include <glm/geometric.hpp>

namespace triptych {

namespace {
const glm::dvec3 light_in_model = glm::normalize(glm::dvec3(0.35, 0.85, 0.40));

GlProgram make_pass(TargetKind kind, Projection projection) {
  const std::string vertex = geometry_vertex_shader(projection);
  switch (kind) {
    case TargetKind::color:
      return make_program("colour", vertex, color_fragment_shader());
    case TargetKind::item:
      return make_program("item", vertex, item_fragment_shader());
    case TargetKind::depth_only:
      return make_program("depth", vertex, depth_fragment_shader());
    case TargetKind::color_and_item:
      break;
  }
  return make_program("colour and item", vertex, color_and_item_fragment_shader());
}

}  // namespace

Renderer::Renderer(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : geometry_(skeleton, residency), representation_(representation), builder_(skeleton) {}

Renderer::Pass& Renderer::pass(TargetKind kind) {
  const Projection projection = view_->view().camera.projection;
  std::optional<Pass>& pass = passes_[static_cast<size_t>(projection)][static_cast<size_t>(kind)];
  if (pass) return *pass;
  pass.emplace(Pass{make_pass(kind, projection)});
  pass->frustum = glGetUniformLocation(pass->program, "frustum");
  pass->depth = glGetUniformLocation(pass->program, "depth");
  pass->light = glGetUniformLocation(pass->program, "light");
  return *pass;
}

void Renderer::set_projection(const Pass& pass) const {
  const Camera& camera = view_->view().camera;
  const ClipSpace& clip = view_->clip;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  const double shift_x = (camera.right + camera.left) / width,
               shift_y = (camera.top + camera.bottom) / height;
  const double scale = clip.orthographic ? 2 * clip.unit : 2;  // sides are tangents, or model units
  const double side = clip.orthographic ? -1 : 1;              // shifts are multiplied by −z, or by 1
  glUniform4f(pass.frustum, static_cast<float>(scale / width), static_cast<float>(scale / height),
              static_cast<float>(side * shift_x), static_cast<float>(side * shift_y));
  if (clip.orthographic) {
    glUniform2f(pass.depth, static_cast<float>(clip.unit / clip.range),
                static_cast<float>(clip.depth(clip.reference_depth)));
  } else {
    glUniform2f(pass.depth, static_cast<float>(clip.near / clip.unit), 0);
  }
}

void Renderer::set_view(const FrameView& view) {
  if (view_ && view.state == view_->state && view.rules == view_->rules) return;
  view_ = view;
  representation_.begin(view);
  builder_.begin(view);
}

uint64_t Renderer::draw(std::span<const DrawableId> drawables, const Framebuffer& framebuffer) {
  if (drawables.empty()) return 0;
  items_.clear();
  for (const DrawableId id : drawables) representation_.append(id, items_);
  geometry_.require(items_);
  list_.clear();
  builder_.append(geometry_.ranges(), items_, list_);
  if (list_.commands.empty()) return 0;
  records_.upload(std::span<const DrawRecord>(list_.records));
  bounds_.upload(std::span<const BoundRecord>(list_.bounds));
  commands_.upload(std::span<const DrawCommand>(list_.commands));

  const Pass& used = pass(framebuffer.kind());
  glUseProgram(used.program);
  set_projection(used);
  if (used.light >= 0) {
    const glm::vec3 light(view_->rotation * light_in_model);
    glUniform3f(used.light, light.x, light.y, light.z);
  }
  framebuffer.bind();
  geometry_.bind();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, draws_binding, records_);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bounds_binding, bounds_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);  // reversed depth; strict, so that the lower draw rank wins where depths are equal
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                              static_cast<GLsizei>(list_.commands.size()), 0);
  return list_.triangles;
}

}  // namespace triptych
