// What all targets of a device share: its geometry, and how drawables are placed under a view.
#pragma once

#include "lod/representation.hpp"
#include "raster/caps.hpp"
#include "raster/chunk_geometry.hpp"
#include "raster/sample_planes.hpp"
#include "raster/texture_levels.hpp"
#include "raster/transparent_layers.hpp"
#include "visibility/cut_bodies.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// Draws drawables of one pack.
class RasterScene {
 public:
  RasterScene(const Skeleton& skeleton, Representation& representation, Residency& residency);

  /// What follows is drawn under this view.
  void set_view(const FrameView& view);
  /// Draws them into each plane, as many as the view has samples, but for what is transparent; how many
  /// triangles they are, with those. transparent: drawables that have such are appended.
  uint64_t draw(std::span<const DrawableId> drawables, SamplePlanes& planes,
                std::vector<DrawableId>& transparent);
  /// What of drawables is transparent, over each plane.
  std::vector<TransparentLayers> transparent_layers(std::span<const DrawableId> drawables,
                                                    const SamplePlanes& planes, size_t max_fragments);

  const Skeleton& skeleton() const { return skeleton_; }
  const TextureLevels& textures() const { return textures_; }
  /// TextureLevels::fit().
  bool fit_textures() { return textures_.fit(); }
  /// Of a pack with textures a share of it is theirs.
  void set_geometry_cap(uint64_t bytes) {
    const bool shared = !skeleton_.textures.empty() && bytes != no_cap;
    if (shared) textures_.set_cap(bytes / texture_share);
    geometry_.set_cap(shared ? bytes - bytes / texture_share : bytes);
    cap_changed_ = true;
  }
  void set_missing(const MissingChunks& missing) {
    geometry_.set_missing(missing);
    textures_.set_missing(missing);
  }
  GeometryUse geometry_use() const {
    GeometryUse use = geometry_.use();
    use.textures = textures_.use();
    return use;
  }
  bool has_chunk(uint32_t chunk) const { return geometry_.has(chunk); }
  bool is_damaged(uint32_t chunk) const { return geometry_.is_damaged(chunk); }

 private:
  /// Textures may stay beside geometry up to this share of its cap.
  static constexpr uint64_t texture_share = 4;
  /// Of a draw item: its drawable, and which of that's items it is.
  struct Name {
    DrawRank rank = {};
    uint32_t part = 0;
  };
  /// Asks for the drawables' geometry, and fills `stretches_` and `transparent_stretches_`; how many
  /// triangles.
  uint64_t place(std::span<const DrawableId> drawables);
  void add_cap_runs();
  /// As many boxes as the chunk has pieces.
  std::span<const LatticeBox> everywhere(uint32_t chunk) const {
    return std::span(everywhere_).first(skeleton_.pieces_of(chunk).size());
  }

  const Skeleton& skeleton_;
  Representation& representation_;
  ChunkGeometry geometry_;
  TextureLevels textures_;
  LatticePlacer placer_;
  std::optional<FrameView> view_;
  bool cap_changed_ = false;  ///< since the view began
  std::optional<BoxProjector> projector_;
  std::vector<GeometryTerms> terms_;  ///< of each sample
  std::vector<DrawRank> ranks_;
  std::vector<DrawItem> items_;
  std::vector<Name> names_;  ///< of `items_`
  std::vector<PlacedStretch> stretches_, transparent_stretches_;
  CutBodies cut_bodies_;
  std::vector<PlacedCapRun> cap_runs_;
  CapCounters cap_counters_;
  std::vector<LatticeBox> everywhere_;  ///< as pieces of what is not drawn
};

}  // namespace triptych
