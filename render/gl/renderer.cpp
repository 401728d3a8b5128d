#include "render/gl/renderer.hpp"

#include "render/gl/shaders.hpp"

namespace triptych {

namespace {
GlProgram make_pass(TargetKind kind, Projection projection, const ShaderVariant& variant) {
  const std::string vertex = geometry_vertex_shader(projection, variant);
  if (variant.transparent) return make_program("transparent", vertex, transparent_fragment_shader(variant));
  switch (kind) {
    case TargetKind::color:
      return make_program("colour", vertex, color_fragment_shader(variant));
    case TargetKind::item:
      return make_program("item", vertex, item_fragment_shader(variant));
    case TargetKind::depth_only:
      return make_program("depth", vertex, depth_fragment_shader(variant));
    case TargetKind::color_and_item:
      break;
  }
  return make_program("colour and item", vertex, color_and_item_fragment_shader(variant));
}

uint32_t pass_key(TargetKind kind, Projection projection, const ShaderVariant& variant) {
  uint32_t key = 0;
  for (const bool bit : {variant.sections, variant.caps, variant.layers, variant.normals, variant.transparent,
                         variant.textured, variant.emissive, variant.baked, variant.occluded, variant.smooth,
                         variant.colors == BaseColors::vertices})
    key = key << 1 | (bit ? 1u : 0u);
  return key << 8 | static_cast<uint32_t>(projection) << 4 | static_cast<uint32_t>(kind);
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

/// So many, from that byte of the buffer on.
void draw_commands(uintptr_t offset, uint32_t count) {
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                              static_cast<GLsizei>(count), 0);
}

}  // namespace

Renderer::Renderer(const Skeleton& skeleton, Representation& representation, Residency& residency)
    : baked_(calls_for(skeleton.effects, Effect::baked_light)),
      ambient_(calls_for(skeleton.effects, Effect::ambient)),
      geometry_(skeleton, residency),
      representation_(representation),
      builder_(skeleton),
      cut_bodies_(skeleton) {}

Renderer::Pass& Renderer::pass(TargetKind kind, const ShaderVariant& variant) {
  const Projection projection = view_->view().camera.projection;
  const uint32_t key = pass_key(kind, projection, variant);
  if (const auto found = passes_.find(key); found != passes_.end()) return found->second;
  if (variant.colors == BaseColors::vertices) ++use(Effect::vertex_colors).variants;
  if (variant.smooth) ++use(Effect::smooth_normals).variants;
  if (variant.textured) ++use(Effect::textures).variants;
  if (variant.emissive) ++use(Effect::emission).variants;
  if (variant.baked) ++use(Effect::baked_light).variants;
  if (variant.occluded) ++use(Effect::ambient).variants;
  if (variant.transparent) ++use(Effect::transparency).variants;
  return passes_.emplace(key, make_pass(kind, projection, variant)).first->second;
}

Renderer::Pass& Renderer::winding_pass() {
  const Projection projection = view_->view().camera.projection;
  std::optional<Pass>& pass = winding_passes_[static_cast<size_t>(projection)];
  if (!pass) {
    const ShaderVariant variant{.sections = true};
    pass.emplace(
        make_program("winding", geometry_vertex_shader(projection, variant), winding_fragment_shader()));
  }
  return *pass;
}

Renderer::Pass& Renderer::transparent_pass(const DrawGroup& group) {
  ShaderVariant variant = variant_for(group, true);
  variant.transparent = true;
  return pass(TargetKind::color, variant);
}

ShaderVariant Renderer::variant_for(const DrawGroup& group, bool has_colors) {
  const bool colored = group.colored && has_colors && shows(Effect::vertex_colors);
  const bool baked = group.lit && has_colors && baked_ && shows(Effect::baked_light);
  return {.colors = colored ? BaseColors::vertices : BaseColors::palette,
          .smooth = has_colors && shows_normals(group),
          .layers = group.layered,
          .sections = !view_->section_space.keeps_all(),
          .textured = group.textured && (has_colors || group.cut_out) && shows(Effect::textures),
          .emissive = group.emissive && has_colors && shows(Effect::emission),
          .baked = baked,
          .occluded = group.lit && has_colors && !baked && ambient_ && shows(Effect::ambient)};
}

void Renderer::count_uses(const DrawGroup& group, const ShaderVariant& variant, uint64_t draws,
                          uint64_t binds) {
  const auto count = [&](bool takes_part, Effect effect) {
    if (!takes_part) return;
    use(effect).draws += draws;
    use(effect).binds += binds;
  };
  count(variant.colors == BaseColors::vertices, Effect::vertex_colors);
  count(variant.smooth && group.normals == ChunkNormals::of_files, Effect::smooth_normals);
  count(variant.textured, Effect::textures);
  count(variant.emissive, Effect::emission);
  count(variant.baked, Effect::baked_light);
  count(variant.occluded, Effect::ambient);
}

void Renderer::set_view(const FrameView& view) {
  // A changed cap holds for a camera that rests, too.
  const bool same = view_ && view.state == view_->state && view.rules == view_->rules;
  if (same && !geometry_.cap_changed()) return;
  view_ = view;
  for (EffectUse& use : uses_) use = {.variants = use.variants};
  geometry_.begin_view();
  representation_.begin(view);
  builder_.begin(view);
}

bool Renderer::make_list(std::span<const DrawableId> drawables, DrawPart part) {
  items_.clear();
  for (const DrawableId id : drawables) representation_.append(id, items_);
  geometry_.require(items_);
  if (shows(Effect::textures)) use(Effect::textures).upload_bytes += geometry_.require_textures(items_);
  list_.clear();
  if (part != DrawPart::transparent) {
    cut_bodies_.find(*view_, items_);
    for (const CutRun& run : cut_bodies_.runs()) geometry_.require(run.chunk);
  }
  builder_.append(geometry_.ranges(), items_, cut_bodies_, part, list_);
  if (list_.commands.empty()) return false;
  records_.upload(std::span<const DrawRecord>(list_.records));
  bounds_.upload(std::span<const PixelDepthBound>(list_.bounds));
  commands_.upload(std::span<const DrawCommand>(list_.commands));
  return true;
}

uint64_t Renderer::draw(std::span<const DrawableId> drawables, const Framebuffer& framebuffer,
                        std::vector<DrawableId>& transparent) {
  if (drawables.empty()) return 0;
  const bool opaque = shows(Effect::transparency);
  const bool draws = make_list(drawables, opaque ? DrawPart::opaque : DrawPart::all);
  for (const DrawItem& item : items_) {
    if (!opaque || geometry_.ranges()[item.chunk].transparent.empty()) continue;
    if (transparent.empty() || transparent.back() != item.drawable) transparent.push_back(item.drawable);
  }
  if (!draws) return list_.triangles;
  const auto places = sample_places(framebuffer.layout().samples);
  for (uint32_t plane = 0; plane < places.size(); ++plane) draw_list(framebuffer, plane, places[plane]);
  return list_.triangles;
}

void Renderer::draw_list(const Framebuffer& framebuffer, uint32_t plane, const SamplePlace& place) {
  const TargetKind kind = framebuffer.kind();
  const Pass *surfaces = nullptr, *caps = nullptr, *winding = nullptr;
  const auto prepared = [&](const Pass& used) {
    glUseProgram(used.program);
    used.uniforms.set(*view_, place);
    return &used;
  };
  ShaderVariant variant;
  const auto prepare = [&](const DrawGroup& group) {
    variant = variant_for(group, framebuffer.has_colors());
    count_uses(group, variant, 0, 1);
    variant.normals = framebuffer.has_colors() && framebuffer.layout().normals;
    if (variant.sections) {
      ShaderVariant of_caps = variant;
      of_caps.caps = true;
      of_caps.smooth = of_caps.textured = of_caps.emissive = of_caps.baked = of_caps.occluded = false;
      bind_nearest_backs(framebuffer.width(), framebuffer.height());
      winding = prepared(winding_pass());
      caps = prepared(pass(kind, of_caps));
    }
    surfaces = prepared(pass(kind, variant));
    geometry_.bind(records_, group);
  };
  const DrawGroup* bound = &list_.groups.front();
  prepare(*bound);
  framebuffer.bind(plane);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bounds_binding, bounds_);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);  // reversed depth; strict, so that the lower draw rank wins where depths are equal
  uintptr_t offset = 0;
  for (const DrawGroup& group : list_.groups) {
    if (!group.is_alike(*bound)) prepare(group);
    bound = &group;
    count_uses(group, variant, group.count, 0);
    show_sides(group.front);
    if (group.caps == DrawGroup::Caps::none) {
      draw_commands(offset, group.count);
    } else {
      draw_caps(group, offset, *winding, *caps);
      glUseProgram(surfaces->program);
    }
    offset += (group.count + group.shown) * sizeof(DrawCommand);
  }
  show_sides(0);
}

void Renderer::draw_transparent(std::span<const DrawableId> drawables, const Framebuffer& framebuffer,
                                FragmentLists& lists, VisibleSet* owners) {
  EffectUse& counts = use(Effect::transparency);
  lists.begin(framebuffer);
  const bool draws = make_list(drawables, DrawPart::transparent);
  if (draws) {
    counts.upload_bytes += list_.records.size() * sizeof(DrawRecord) +
                           list_.bounds.size() * sizeof(PixelDepthBound) +
                           list_.commands.size() * sizeof(DrawCommand);
  }
  const auto places = sample_places(framebuffer.layout().samples);
  for (uint32_t plane = 0; plane < places.size(); ++plane) {
    const auto draw_all = [&] {
      if (!draws) return;
      glBindBufferBase(GL_SHADER_STORAGE_BUFFER, bounds_binding, bounds_);
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_);
      show_sides(0);
      uintptr_t offset = 0;
      const DrawGroup* bound = nullptr;
      for (const DrawGroup& group : list_.groups) {
        if (bound == nullptr || !group.is_alike(*bound)) {
          const Pass& pass = transparent_pass(group);
          glUseProgram(pass.program);
          pass.uniforms.set(*view_, places[plane]);
          glUniform1i(glGetUniformLocation(pass.program, "plane"), static_cast<GLint>(plane));
          geometry_.bind(records_, group);
          ++counts.binds;
        }
        bound = &group;
        draw_commands(offset, group.count);
        offset += group.count * sizeof(DrawCommand);
        counts.draws += group.count;
      }
    };
    lists.make(framebuffer, plane, draw_all, owners);
  }
  counts.fragments += lists.fragments();
  counts.splits += lists.splits();
}

void Renderer::bind_nearest_backs(int width, int height) {
  if (!nearest_backs_ || nearest_backs_->width != width || nearest_backs_->height != height) {
    nearest_backs_.emplace(width, height);
    glTextureStorage2D(nearest_backs_->texture, 1, GL_R32UI, width, height);
    glClearTexImage(nearest_backs_->texture, 0, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
  }
  glBindImageTexture(nearest_backs_image, nearest_backs_->texture, 0, GL_FALSE, 0, GL_READ_WRITE, GL_R32UI);
}

/// Of a closed surface: counts in the stencil what rays pass beyond where they come into
/// the section, backs less fronts; draws before the nearest back where that is above 0; and forgets both.
void Renderer::draw_caps(const DrawGroup& group, uintptr_t offset, const Pass& winding, const Pass& caps) {
  const auto draw = [&] {
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    draw_commands(offset, group.count);
  };
  const auto write = [](GLboolean on) {
    glColorMask(on, on, on, on);
    glDepthMask(on);
    glDepthFunc(on ? GL_GREATER : GL_ALWAYS);
  };
  const bool mirrored = group.caps == DrawGroup::Caps::mirrored;
  glEnable(GL_STENCIL_TEST);
  glUseProgram(winding.program);
  const GLint forget = glGetUniformLocation(winding.program, "forget");
  glUniform1i(forget, 0);
  write(GL_FALSE);
  glStencilFunc(GL_ALWAYS, winding_zero, 0xff);
  glStencilOpSeparate(GL_FRONT, GL_KEEP, GL_KEEP, mirrored ? GL_INCR_WRAP : GL_DECR_WRAP);
  glStencilOpSeparate(GL_BACK, GL_KEEP, GL_KEEP, mirrored ? GL_DECR_WRAP : GL_INCR_WRAP);
  draw();
  glUseProgram(caps.program);
  write(GL_TRUE);
  glStencilFunc(GL_LESS, winding_zero, 0xff);  // zero is less than what is there
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
  show_sides(mirrored ? 1 : -1);
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  draw_commands(offset + group.count * sizeof(DrawCommand), group.shown);
  show_sides(0);
  glUseProgram(winding.program);
  glUniform1i(forget, 1);
  write(GL_FALSE);
  glStencilFunc(GL_ALWAYS, winding_zero, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
  draw();
  write(GL_TRUE);
  glDisable(GL_STENCIL_TEST);
}

}  // namespace triptych
