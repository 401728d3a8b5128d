#include "render/gl/renderer.hpp"

#include "render/gl/shaders.hpp"
#include "scene/layers.hpp"

namespace triptych {

namespace {
GlProgram make_pass(TargetKind kind, Projection projection, BaseColors colors, Layers layers, bool normals) {
  const std::string vertex = geometry_vertex_shader(projection, colors, layers);
  switch (kind) {
    case TargetKind::color:
      return make_program("colour", vertex, color_fragment_shader(colors, layers, normals));
    case TargetKind::item:
      return make_program("item", vertex, item_fragment_shader(layers));
    case TargetKind::depth_only:
      return make_program("depth", vertex, depth_fragment_shader(layers));
    case TargetKind::color_and_item:
      break;
  }
  return make_program("colour and item", vertex, color_and_item_fragment_shader(colors, layers, normals));
}

/// Of triangles whose fronts go round so; 0: both.
void show_sides(int32_t front) {
  if (front == 0) {
    glDisable(GL_CULL_FACE);
    return;
  }
  glEnable(GL_CULL_FACE);
  glCullFace(front > 0 ? GL_BACK : GL_FRONT);
}

}  // namespace

Renderer::Renderer(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : layers_(has_layers(skeleton.effects) ? Layers::some : Layers::none),
      geometry_(skeleton, residency),
      representation_(representation),
      builder_(skeleton) {}

Renderer::Pass& Renderer::pass(TargetKind kind, BaseColors colors, bool normals) {
  const Projection projection = view_->view().camera.projection;
  std::optional<Pass>& pass = passes_[normals ? 1 : 0][static_cast<size_t>(colors)]
                                     [static_cast<size_t>(projection)][static_cast<size_t>(kind)];
  if (pass) return *pass;
  pass.emplace(make_pass(kind, projection, colors, layers_, normals));
  return *pass;
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
  bounds_.upload(std::span<const PixelDepthBound>(list_.bounds));
  commands_.upload(std::span<const DrawCommand>(list_.commands));

  const auto places = sample_places(framebuffer.layout().samples);
  for (uint32_t plane = 0; plane < places.size(); ++plane) draw_list(framebuffer, plane, places[plane]);
  return list_.triangles;
}

void Renderer::draw_list(const Framebuffer& framebuffer, uint32_t plane, const SamplePlace& place) {
  const TargetKind kind = framebuffer.kind();
  const auto use = [&](bool colored) {
    const BaseColors colors =
        colored && framebuffer.has_colors() ? BaseColors::vertices : BaseColors::palette;
    const Pass& used = pass(kind, colors, framebuffer.has_colors() && framebuffer.layout().normals);
    glUseProgram(used.program);
    used.uniforms.set(*view_, place);
    geometry_.bind(records_, colored);
  };
  bool colored = list_.groups.front().colored;
  use(colored);
  framebuffer.bind(plane);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bounds_binding, bounds_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);  // reversed depth; strict, so that the lower draw rank wins where depths are equal
  uintptr_t offset = 0;
  for (const DrawGroup& group : list_.groups) {
    if (group.colored != colored) use(colored = group.colored);
    show_sides(group.front);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                static_cast<GLsizei>(group.count), 0);
    offset += group.count * sizeof(DrawCommand);
  }
  show_sides(0);
}

}  // namespace triptych
