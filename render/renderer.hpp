// The passes that draw geometry: depth, colour, items.
#pragma once

#include "render/device_scene.hpp"
#include "render/draw_list.hpp"
#include "render/target.hpp"

#include <optional>
#include <span>

namespace triptych {

/// Draws drawables of one pack under one view at a time, into targets.
class Renderer {
 public:
  explicit Renderer(const Pack& pack);

  /// The view for the draws that follow.
  void set_view(const View& view);
  /// Draws in the order given; at equal depth what was drawn first stays. What the target holds already stays
  /// too. Returns the triangles that were drawn.
  uint64_t draw(std::span<const DrawableId> drawables, const Target& target, TargetKind pass);

  const Skeleton& skeleton() const { return scene_.skeleton(); }
  uint64_t device_bytes() const { return scene_.device_bytes(); }

 private:
  struct Pass {
    GlProgram program;
    GLint frustum = -1, depth = -1, light = -1;
  };
  Pass& pass(TargetKind kind);
  void set_projection(const Pass& pass) const;

  DeviceScene scene_;
  std::optional<Pass> passes_[2][4];  ///< by projection; a program exists only once something calls for it
  std::optional<DrawListBuilder> builder_;
  View view_;
  StreamBuffer records_, bounds_, commands_;
};

}  // namespace triptych
