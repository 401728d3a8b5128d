// One pack on one device at one size and with one number of samples: what all settings that are compared
// there share.
#pragma once

#include "measure/accuracy/accuracy.hpp"
#include "measure/accuracy/butteraugli.hpp"
#include "measure/accuracy/finer_reference.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/picture_stage.hpp"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// What is wanted of a frame besides its times.
struct FramePlan {
  bool compare = false;     ///< look at its pictures
  bool keep = false;        ///< keep its colours, for the frames after it
  bool perceptual = false;  ///< ask butteraugli
  bool exhibit = false;     ///< keep its pictures for people
};

class AccuracyGround {
 public:
  /// Appends its rows to `result`, which it fills as frames are drawn. All but the options must outlive it.
  AccuracyGround(const AccuracySubject& subject, const SpeedDevice& device, const PackSurfaces& surfaces,
                 std::span<const FrameRequest> frames, const AccuracyOptions& options,
                 const std::optional<Butteraugli>& perceptual, AccuracyResult& result);

  /// How many settings there are.
  size_t turns() const { return settings_.size(); }
  /// Before the settings' turns: draws the reference and the whole cuts, and compares those.
  void begin(size_t frame, const FramePlan& plan);
  /// Draws the frame by one setting, timed, and compares.
  void draw(size_t setting, size_t frame, const FramePlan& plan);

 private:
  /// The whole cut at one pixel error.
  struct WholeCut {
    double pixel_error;
    std::shared_ptr<PictureTally> tally;
    ShownPicture picture{};
    RecentColors recent{};
    Cut cut{};
    VisibleSet owners{};
    PictureMeasures measures{};
  };
  struct Setting {
    size_t row = 0, whole_cut = 0;
    bool exact = true;
    std::unique_ptr<Strategy> strategy{};
    std::unique_ptr<LocalPipeline> pipeline{};
    RecentColors recent{};  ///< of an approximate one
  };

  FrameState state_of(size_t frame, double pixel_error) const;
  FrameView view_of(size_t frame, double pixel_error) const;
  ShownPicture draw_picture(const FrameView& view, std::span<const DrawableId> ordered);
  /// ShownPicture::items alone.
  std::vector<uint32_t> draw_items(const FrameView& view, std::span<const DrawableId> ordered);
  void compare_whole_cut(WholeCut& whole, size_t frame, const FramePlan& plan);
  void compare_setting(Setting& setting, size_t frame, const FramePlan& plan, const FrameRecord& record);
  /// What the setting's picture was drawn of, ascending: V(i), and R(i) where that is the picture.
  VisibleSet drawn_of(const Setting& setting, const FrameRecord& record) const;
  /// Before a frame that is not the path's next one: nothing moves between them.
  void forget_motion();
  void add_motion(PictureMeasures& measures, const RecentColors& recent) const;
  void measure_covers(size_t frame);
  /// Adds what drawables of a shifted view cover of the small leaves.
  void add_cover(const FrameView& shifted, std::span<const DrawableId> ordered, CoverCounts& counts);
  double perceptual_distance(const ShownPicture& shown) const;

  const SpeedDevice& device_;
  const PackSurfaces& surfaces_;
  const Skeleton& skeleton_;
  Hiding hiding_;
  std::span<const FrameRequest> frames_;
  AccuracyOptions options_;
  const std::optional<Butteraugli>& perceptual_;
  AccuracyResult& result_;
  bool first_;  ///< of all grounds: its pictures are for people, too
  FrameRules rules_ = injected_frame_rules();
  uint32_t samples_;
  PictureStage picture_;                 ///< with the drawables at each sample
  std::optional<PictureStage> centers_;  ///< the drawables at pixels' centres, where those are no samples
  CutLister lister_;
  std::vector<size_t> points_;
  ShownPicture reference_;
  std::optional<FinerReference> finer_;  ///< of the frame that is compared
  RecentColors recent_reference_;
  std::vector<SceneNodeId> small_leaves_;  ///< of the reference that was compared last
  CoverCounts reference_cover_;            ///< of those
  std::vector<WholeCut> whole_cuts_;
  std::vector<Setting> settings_;
};

}  // namespace triptych
