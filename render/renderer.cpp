#include "render/renderer.hpp"

#include "render/shaders.hpp"

#include <glm/geometric.hpp>

namespace triptych {

namespace {
const glm::dvec3 light_in_model = glm::normalize(glm::dvec3(0.35, 0.85, 0.40));

GlProgram make_pass(TargetKind kind) {
  switch (kind) {
    case TargetKind::color:
      return make_program("colour", geometry_vertex_shader(), color_fragment_shader());
    case TargetKind::item:
      return make_program("item", geometry_vertex_shader(), item_fragment_shader());
    case TargetKind::depth_only:
      return make_program("depth", geometry_vertex_shader(), depth_fragment_shader());
    case TargetKind::color_and_item:
      break;
  }
  return make_program("colour and item", geometry_vertex_shader(), color_and_item_fragment_shader());
}

}  // namespace

Renderer::Renderer(const Pack& pack) : scene_(pack) {}

Renderer::Pass& Renderer::pass(TargetKind kind) {
  std::optional<Pass>& pass = passes_[static_cast<size_t>(kind)];
  if (pass) return *pass;
  pass.emplace(Pass{make_pass(kind)});
  pass->frustum = glGetUniformLocation(pass->program, "frustum");
  pass->near = glGetUniformLocation(pass->program, "near");
  pass->light = glGetUniformLocation(pass->program, "light");
  return *pass;
}

void Renderer::set_view(const View& view) {
  if (builder_ && view == view_) return;
  view_ = view;
  builder_.emplace(scene_.skeleton(), view);
}

uint64_t Renderer::draw(std::span<const DrawableId> drawables, const Target& target, TargetKind kind) {
  if (drawables.empty()) return 0;
  scene_.require(drawables);
  DrawListBuilder::DrawList list;
  builder_->append(scene_, drawables, list);
  if (list.commands.empty()) return 0;
  records_.upload(std::span<const DrawRecord>(list.records));
  commands_.upload(std::span<const DrawCommand>(list.commands));

  const Pass& used = pass(kind);
  const Camera& camera = view_.camera;
  const double width = camera.right - camera.left, height = camera.top - camera.bottom;
  glUseProgram(used.program);
  glUniform4f(used.frustum, static_cast<float>(2 / width), static_cast<float>(2 / height),
              static_cast<float>((camera.right + camera.left) / width),
              static_cast<float>((camera.top + camera.bottom) / height));
  glUniform1f(used.near, static_cast<float>(camera.near));
  if (used.light >= 0) {
    const glm::vec3 light(view_.rotation() * light_in_model);
    glUniform3f(used.light, light.x, light.y, light.z);
  }
  target.bind();
  scene_.bind();
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, draws_binding, records_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);  // reversed depth; strict, so that the lower draw rank wins where depths are equal
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr,
                              static_cast<GLsizei>(list.commands.size()), 0);
  return list.triangles;
}

}  // namespace triptych
