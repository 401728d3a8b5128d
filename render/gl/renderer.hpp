// The passes that draw geometry: depth, colour, items.
#pragma once

#include "render/draw_list.hpp"
#include "render/gl/fragment_lists.hpp"
#include "render/gl/framebuffer.hpp"
#include "render/gl/geometry.hpp"
#include "render/gl/shaders.hpp"
#include "render/gl/view_uniforms.hpp"

#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace triptych {

/// Draws drawables of one pack under one frame view at a time, into framebuffers.
class Renderer {
 public:
  Renderer(const Skeleton& skeleton, Representation& representation, Residency& residency);

  /// The view for the draws that follow.
  void set_view(const FrameView& view);
  /// Draws in the order given, over what the framebuffer holds already, each of its planes at a sample of its
  /// own; at equal depth what was drawn first stays. Returns the number of triangles of the drawables. What
  /// is transparent is left to draw_transparent(): drawables that have such are appended to `transparent`.
  uint64_t draw(std::span<const DrawableId> drawables, const Framebuffer& framebuffer,
                std::vector<DrawableId>& transparent);
  /// The drawables' transparent triangles over all planes of the framebuffer, which stay as they are: the
  /// veils of `lists`. Drawables come in draw rank order. owners: as FragmentLists::make().
  void draw_transparent(std::span<const DrawableId> drawables, const Framebuffer& framebuffer,
                        FragmentLists& lists, VisibleSet* owners);
  /// Of draw_transparent() and, where chunks call for it, of draw() since set_view() made a view anew.
  const EffectUse& effect_use(Effect effect) const { return uses_[static_cast<size_t>(effect)]; }
  void set_geometry_cap(uint64_t bytes) { geometry_.set_cap(bytes); }
  void set_missing(const MissingChunks& missing) { geometry_.set_missing(missing); }
  GeometryUse geometry_use() const { return geometry_.use(); }
  bool has_chunk(uint32_t chunk) const { return geometry_.has(chunk); }
  bool is_damaged(uint32_t chunk) const { return geometry_.is_damaged(chunk); }

 private:
  struct Pass {
    explicit Pass(GlProgram made) : program(std::move(made)), uniforms(program) {}
    GlProgram program;
    ViewUniforms uniforms;
  };
  Pass& pass(TargetKind kind, const ShaderVariant& variant);
  Pass& winding_pass();
  Pass& transparent_pass(const DrawGroup& group);
  /// Whether the view shows normals of its vertices.
  bool shows_normals(const DrawGroup& group) const {
    return group.normals == ChunkNormals::of_levels ||
           (group.normals == ChunkNormals::of_files && shows(Effect::smooth_normals));
  }
  /// What a pass over a group's surfaces has of what its chunks call for.
  ShaderVariant variant_for(const DrawGroup& group, bool has_colors);
  /// Of a group that is drawn by a pass with the variant.
  void count_uses(const DrawGroup& group, const ShaderVariant& variant, uint64_t draws, uint64_t binds);
  /// Makes the list of the drawables' part, and uploads it; false where it is empty.
  bool make_list(std::span<const DrawableId> drawables, DrawPart part);
  EffectUse& use(Effect effect) { return uses_[static_cast<size_t>(effect)]; }
  bool shows(Effect effect) const { return view_->state.effects.has(effect); }
  /// Into one plane of the framebuffer, whose pixel centres lie at this sample of each pixel.
  void draw_list(const Framebuffer& framebuffer, uint32_t plane, const SamplePlace& place);
  void bind_nearest_backs(int width, int height);
  void draw_caps(const DrawGroup& group, uintptr_t offset, const Pass& winding, const Pass& caps);

  bool baked_, ambient_;
  Geometry geometry_;
  /// By variant, projection and kind (pass_key()); made when first used.
  std::map<uint32_t, Pass> passes_;
  std::optional<Pass> winding_passes_[2];  ///< by projection
  /// Of a picture: the bits of depths of the nearest backs of what draw_caps() counts, 0 between its uses.
  struct NearestBacks {
    int width, height;
    GlTexture texture = {};
  };
  std::optional<NearestBacks> nearest_backs_;
  Representation& representation_;
  DrawListBuilder builder_;
  CutBodies cut_bodies_;
  std::vector<DrawItem> items_;
  DrawList list_;
  std::optional<FrameView> view_;
  std::array<EffectUse, all_effects.size()> uses_ = {};
  StreamBuffer records_, bounds_, commands_;
};

}  // namespace triptych
