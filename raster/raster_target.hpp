// A frame target of the rasteriser.
#pragma once

#include "base/epoch_marks.hpp"
#include "raster/raster_device.hpp"
#include "raster/sample_planes.hpp"
#include "raster/shade.hpp"
#include "visibility/cut_bodies.hpp"
#include "visibility/frame_target.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// Draws drawables of one pack; what all targets of a device share.
class RasterScene {
 public:
  RasterScene(const Skeleton& skeleton, Representation& representation, Residency& residency);

  /// What follows is drawn under this view.
  void set_view(const FrameView& view);
  /// Draws them into each plane, as many as the view has samples; how many triangles they are.
  uint64_t draw(std::span<const DrawableId> drawables, SamplePlanes& planes);

  const Skeleton& skeleton() const { return skeleton_; }
  void set_geometry_cap(uint64_t bytes) {
    geometry_.set_cap(bytes);
    cap_changed_ = true;
  }
  void set_missing(const MissingChunks& missing) { geometry_.set_missing(missing); }
  const GeometryUse& geometry_use() const { return geometry_.use(); }
  bool has_chunk(uint32_t chunk) const { return geometry_.has(chunk); }
  bool is_damaged(uint32_t chunk) const { return geometry_.is_damaged(chunk); }

 private:
  /// Of a draw item: its drawable, and which of that's items it is.
  struct Name {
    DrawRank rank = {};
    uint32_t part = 0;
  };
  void add_cap_runs();
  /// As many boxes as the chunk has pieces.
  std::span<const LatticeBox> everywhere(uint32_t chunk) const {
    return std::span(everywhere_).first(skeleton_.pieces_of(chunk).size());
  }

  const Skeleton& skeleton_;
  Representation& representation_;
  ChunkGeometry geometry_;
  LatticePlacer placer_;
  std::optional<FrameView> view_;
  bool cap_changed_ = false;  ///< since the view began
  std::optional<BoxProjector> projector_;
  std::vector<GeometryTerms> terms_;  ///< of each sample
  std::vector<DrawRank> ranks_;
  std::vector<DrawItem> items_;
  std::vector<Name> names_;  ///< of `items_`
  std::vector<PlacedStretch> stretches_;
  CutBodies cut_bodies_;
  std::vector<PlacedCapRun> cap_runs_;
  CapCounters cap_counters_;
  std::vector<LatticeBox> everywhere_;  ///< as pieces of what is not drawn
};

class RasterTarget final : public FrameTarget {
 public:
  RasterTarget(RasterScene& scene, TargetKind kind, int width, int height, const RasterOptions& options);

  int width() const override { return planes_.front().width(); }
  int height() const override { return planes_.front().height(); }
  TargetKind kind() const override { return kind_; }
  DeviceMargins margins() const override;
  void begin(const FrameView& view) override;
  /// Those that were drawn since begin() already are left out.
  void draw(std::span<const DrawableId> drawables) override;
  void test(std::span<const ScreenRectangle> rectangles, std::span<const uint32_t> ends, uint32_t min_pixels,
            std::span<uint8_t> visible) override;
  /// Makes the picture.
  void finish() override;
  uint64_t drawn_triangles() const override { return drawn_triangles_; }
  void draw_lines(std::span<const ScreenLine> lines) override;
  std::vector<uint8_t> read_colors() const override;
  std::vector<uint32_t> read_items(uint32_t sample) const override;
  bool hides(const ScreenExtent& extent) const override;
  std::span<const uint8_t> colors_in_memory() const override;
  bool copy_to_window(int, int) const override { return false; }

 private:
  bool has_colors() const { return kind_ == TargetKind::color || kind_ == TargetKind::color_and_item; }
  void make_planes(size_t count, int width, int height);
  void make_picture() const;

  RasterScene& scene_;
  TargetKind kind_;
  uint64_t max_slots_;
  SamplePlanes planes_;
  std::optional<FrameView> view_;
  EpochMarks drawn_;  ///< drawables
  std::vector<DrawableId> fresh_;
  uint64_t drawn_triangles_ = 0;
  // Made when somebody wants it.
  mutable std::vector<Rgba> picture_;
  mutable bool picture_is_made_ = false;
};

}  // namespace triptych
