// A frame target of the rasteriser.
#pragma once

#include "base/epoch_marks.hpp"
#include "raster/raster_device.hpp"
#include "raster/raster_scene.hpp"
#include "raster/shade.hpp"
#include "visibility/frame_target.hpp"

#include <optional>
#include <vector>

namespace triptych {

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
  VisibleSet transparent_owners() const override;
  std::span<const EffectUse> effects() const override { return effects_; }
  bool copy_to_window(int, int) const override { return false; }

 private:
  bool has_colors() const { return kind_ == TargetKind::color || kind_ == TargetKind::color_and_item; }
  void make_planes(size_t count, int width, int height);
  void make_picture() const;
  std::vector<TransparentLayers> transparent_layers() const;
  void count_effects(const ShadingCounts& counts, double set_up_ms) const;

  RasterScene& scene_;
  TargetKind kind_;
  RasterOptions options_;
  SamplePlanes planes_;
  std::optional<FrameView> view_;
  EpochMarks drawn_;  ///< drawables
  std::vector<DrawableId> fresh_;
  std::vector<DrawableId> transparent_;  ///< those drawn that have something transparent
  uint64_t drawn_triangles_ = 0;
  // Made when somebody wants it.
  mutable std::vector<Rgba> picture_;
  mutable bool picture_is_made_ = false;
  mutable std::vector<EffectUse> effects_;  ///< of the picture
};

}  // namespace triptych
