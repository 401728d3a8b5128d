// The local pipeline: a session's stages, one after the other, in one process.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/injected_rules.hpp"
#include "nodes/occlusion_stage.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/picture_stage.hpp"
#include "nodes/streaming.hpp"
#include "visibility/strategies.hpp"

#include <map>
#include <memory>
#include <optional>

namespace triptych {

struct LocalPipelineOptions {
  int width = 512, height = 512;
  StrategyKind cull = StrategyKind::occlusion;
  uint32_t min_pixels = StrategyOptions{}.min_pixels;  ///< for `approximate`
  /// For `portals`; found in the pack where they are not given.
  std::shared_ptr<const CellGraph> cells = {};
  CullOptions batches = {};
  DeviceOptions device = {};
  bool item_buffer = false;  ///< draw drawable ids instead of colours
  /// Of frames that have no room within the device's caps.
  MemoryKeeper::NoPixelError no_pixel_error = MemoryKeeper::NoPixelError::fails;
  FrameRules rules = injected_frame_rules();
};

/// Draws frames of a path, in order, from the same stages as a session: R(i) out of V(i−1), the strategy
/// against it, the picture of V(i). Where the order of drawing does not matter (Device::order_matters()),
/// R(i) becomes the picture: V(i−1) is drawn once, and what culling finds is added (Quick-VDR §4); what R(i)
/// holds beyond V(i) is of cut i, too, and hides nothing that shows; of an approximate strategy it may show
/// itself, so that such a picture misses less. After some frames it allocates nothing but what the device
/// does. Of `gl` a context must be current.
class LocalPipeline {
 public:
  /// With the caller's device and strategy; of the options only the size, item_buffer and rules are used.
  LocalPipeline(const Hierarchy& hierarchy, Device& device, Strategy& strategy,
                const LocalPipelineOptions& options);
  /// With a device and strategies of its own.
  LocalPipeline(const Pack& pack, const LocalPipelineOptions& options);

  /// Draws the frame; record and picture are valid until the next one. With the caps of a device of its own
  /// the pixel error is raised where the frame has no room, and the frame drawn anew; with OnMiss::coarser
  /// what is not read yet is drawn coarser, and the record says how much.
  const FrameRecord& draw(const FrameRequest& frame);
  FrameTarget& target() { return picture_->target(); }
  const FrameTarget& target() const { return picture_->target(); }
  Device& device() { return device_; }
  const Device& device() const { return device_; }
  const Hierarchy& hierarchy() const { return hierarchy_; }
  const FrameRules& rules() const { return options_.rules; }
  /// How well reading ahead went; nullopt where nothing is read ahead.
  std::optional<ReadAheadUse> read_ahead() const;
  DrawingMemory memory() const { return {device_.geometry_use(), read_ahead().value_or(ReadAheadUse())}; }
  /// What keeps the caps of a device of its own, for whoever draws its picture() by itself; null where there
  /// are none. first: as frames are drawn; of the first call.
  Streaming* streaming(const FrameState& first);

  /// Culls with this strategy from the next frame on.
  void set_strategy(Strategy& strategy);
  /// The same with a strategy of its own; only for a pipeline that owns its strategies.
  void set_strategy(StrategyKind kind);
  /// Draws in another size from the next frame on; geometry that was loaded stays.
  void resize(int width, int height);
  /// Continues after a frame that was drawn elsewhere, whose V(i−1) is `previous`.
  void resume(const VisibleSet& previous) { visible_ = previous; }
  /// To draw visible sets that come from elsewhere.
  PictureStage& picture() { return *picture_; }
  /// Starts over, as if nothing had been drawn; the next frame is incoherent.
  void forget() { visible_.clear(); }

 private:
  struct Parts {
    Parts(const Pack& of, const LocalPipelineOptions& options)
        : pack(of),
          device(of, options.device),
          strategy_options{options.batches, options.min_pixels, options.cells} {}
    Strategy& strategy(StrategyKind kind);

    const Pack& pack;
    PackDevice device;
    StrategyOptions strategy_options;
    std::map<StrategyKind, std::unique_ptr<Strategy>> strategies;  ///< made when first used
  };
  LocalPipeline(std::unique_ptr<Parts> parts, const LocalPipelineOptions& options);
  void make_occlusion_stage();
  void draw_once(const FrameRequest& frame);

  std::unique_ptr<Parts> parts_;  ///< what the pipeline owns; null where device and strategy are the caller's
  LocalPipelineOptions options_;
  const Hierarchy& hierarchy_;
  Device& device_;
  Strategy* strategy_;
  std::optional<PictureStage> picture_;
  std::unique_ptr<FrameTarget> depth_;  ///< what is tested against; null where the picture is
  std::optional<OcclusionStage> occlusion_;
  VisibleSet visible_, previous_;
  std::vector<DrawableId> ordered_;
  VisibleDelta delta_;
  RankSorter sorter_;
  FrameRecord record_;
  std::optional<Streaming> streaming_;  ///< where there are caps
};

}  // namespace triptych
