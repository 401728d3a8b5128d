#include "measure/device_methods.hpp"

#include "base/clock.hpp"
#include "base/epoch_marks.hpp"
#include "base/progress.hpp"
#include "base/signals.hpp"
#include "lod/cut.hpp"
#include "measure/frame_timing.hpp"
#include "nodes/injected_rules.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/picture_stage.hpp"
#include "visibility/drawable_bounds.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Draws a list of drawables under the frame's view.
class ListMethod : public SpeedMethod {
 public:
  ListMethod(const SpeedDevice& device, std::span<const FrameRequest> frames)
      : skeleton(device.hierarchy.skeleton()),
        frames_(frames),
        device_(device.name),
        picture_(device.device, frames.front().state.view.width, frames.front().state.view.height) {}

  std::string device() const override { return device_; }
  void prepare(size_t frame) override { begin_other_view(picture_.target(), skeleton, frames_[frame]); }
  void draw(size_t frame) override {
    Stopwatch stage;
    const FrameView view(skeleton, frames_[frame].state, rules_);
    const std::vector<DrawableId>& drawables = list(view);
    select_ms_ = stage.milliseconds();
    stage.restart();
    picture_.begin(view, frames_[frame].number);
    draw(view, drawables, picture_);
    picture_.finish();
    draw_ms_ = stage.milliseconds();
  }
  std::vector<SpeedStage> stages() const override { return {{"select", select_ms_}, {"draw", draw_ms_}}; }
  uint64_t drawn_triangles() const override { return picture_.drawn_triangles(); }

 protected:
  /// In draw rank order; good until the next call.
  virtual const std::vector<DrawableId>& list(const FrameView& view) = 0;
  /// All of them, without looking at what they hide.
  virtual void draw(const FrameView&, std::span<const DrawableId> drawables, PictureStage& picture) {
    picture.draw(drawables);
  }

  const Skeleton& skeleton;

 private:
  std::span<const FrameRequest> frames_;
  std::string device_;
  FrameRules rules_ = injected_frame_rules();
  PictureStage picture_;
  double select_ms_ = 0, draw_ms_ = 0;
};

class FrustumMethod : public ListMethod {
 public:
  using ListMethod::ListMethod;
  std::string name() const override { return "frustum"; }

 private:
  const std::vector<DrawableId>& list(const FrameView& view) override { return lister_.list(view); }
  CutLister lister_;
};

/// The same list, from front to back; what is hidden by those before it is not drawn.
class FrustumHidepthMethod final : public FrustumMethod {
 public:
  FrustumHidepthMethod(const SpeedDevice& device, std::span<const FrameRequest> frames)
      : FrustumMethod(device, frames), hierarchy_(device.hierarchy) {}
  std::string name() const override { return "frustum-hidepth"; }

 private:
  /// So many are tested at once: they hide each other only from batch to batch.
  static constexpr size_t batch = 64;

  std::span<const PlacementRun> gone(const FrameView& view, DrawableId id) const {
    const HiddenObjects* const hidden = view.state.hiding.objects.get();
    if (hidden == nullptr) return {};
    return hidden->hidden_placements(skeleton.drawables[id].scene_node);
  }
  using ListMethod::draw;
  void draw(const FrameView& view, std::span<const DrawableId> drawables, PictureStage& picture) override {
    const BoxProjector projector(view, picture.target().margins());
    for (size_t first = 0; first < drawables.size(); first += batch) {
      tested_.clear();
      shown_.clear();
      rectangles_.clear();
      ends_.clear();
      for (const DrawableId id : drawables.subspan(first, std::min(batch, drawables.size() - first))) {
        const ScreenBounds::Kind kind = append_placement_bounds(hierarchy_, projector, id, &picture.target(),
                                                                rectangles_, gone(view, id));
        if (kind == ScreenBounds::Kind::unbounded) shown_.push_back(id);
        if (kind != ScreenBounds::Kind::rectangle) continue;
        tested_.push_back(id);
        ends_.push_back(static_cast<uint32_t>(rectangles_.size()));
      }
      answers_.assign(tested_.size(), 1);
      picture.target().test(rectangles_, ends_, 1, answers_);
      for (size_t i = 0; i < tested_.size(); ++i) {
        if (answers_[i]) shown_.push_back(tested_[i]);
      }
      picture.draw(shown_);
    }
  }

  const Hierarchy& hierarchy_;
  std::vector<DrawableId> tested_, shown_;
  std::vector<ScreenRectangle> rectangles_;
  std::vector<uint32_t> ends_;
  std::vector<uint8_t> answers_;
};

class OracleMethod final : public ListMethod {
 public:
  OracleMethod(const SpeedDevice& device, std::span<const FrameRequest> frames,
               std::span<const VisibleSet> owners)
      : ListMethod(device, frames), owners_(owners), leads_to_owner_(skeleton.scene_nodes.size()) {}

  std::string name() const override { return "oracle"; }
  void prepare(size_t frame) override {
    ListMethod::prepare(frame);
    leads_to_owner_.clear();
    for (const DrawableId id : owners_[frame]) {
      SceneNodeId node = skeleton.drawables[id].scene_node;
      while (node != no_id && leads_to_owner_.mark_first(node)) node = skeleton.scene_nodes[node].parent;
    }
  }

 private:
  const std::vector<DrawableId>& list(const FrameView& view) override {
    chosen_.clear();
    open_.assign(leads_to_owner_.marked(0) ? 1 : 0, 0);
    while (!open_.empty()) {
      const SceneNodeId id = open_.back();
      open_.pop_back();
      const DrawableId choice = choose_level(view, id);
      if (choice != Cut::inner) {
        if (choice != no_id) chosen_.push_back(choice);
        continue;
      }
      const SceneNode& node = skeleton.scene_nodes[id];
      for (SceneNodeId child = node.first_child; child < node.first_child + node.child_count; ++child) {
        if (leads_to_owner_.marked(child)) open_.push_back(child);
      }
    }
    sorter_.sort(view, chosen_);
    return chosen_;
  }

  std::span<const VisibleSet> owners_;
  EpochMarks leads_to_owner_;  ///< scene nodes: those of owners, and all above them
  std::vector<SceneNodeId> open_;
  std::vector<DrawableId> chosen_;
  RankSorter sorter_;
};

class TriptychMethod final : public SpeedMethod {
 public:
  TriptychMethod(const SpeedDevice& device, std::span<const FrameRequest> frames)
      : frames_(frames),
        device_(device.name),
        strategy_(make_exact_strategy(StrategyKind::occlusion, device.hierarchy)),
        pipeline_(device.hierarchy, device.device, *strategy_,
                  {.width = frames.front().state.view.width, .height = frames.front().state.view.height}) {}

  std::string name() const override { return "triptych"; }
  std::string device() const override { return device_; }
  void prepare(size_t frame) override {
    begin_other_view(pipeline_.target(), pipeline_.hierarchy().skeleton(), frames_[frame]);
  }
  void draw(size_t frame) override { record_ = &pipeline_.draw(frames_[frame]); }
  std::vector<SpeedStage> stages() const override {
    return {{"occlusion_representation", record_->occlusion_representation_ms},
            {"hardware_cull", record_->hardware_cull_ms},
            {"render", record_->render_ms}};
  }
  uint64_t drawn_triangles() const override { return record_->drawn_triangles; }

 private:
  std::span<const FrameRequest> frames_;
  std::string device_;
  std::unique_ptr<ExactStrategy> strategy_;
  LocalPipeline pipeline_;
  const FrameRecord* record_ = nullptr;
};

}  // namespace

std::vector<VisibleSet> owners_of_frames(const SpeedDevice& device, std::span<const FrameRequest> frames) {
  std::vector<VisibleSet> sets;
  if (frames.empty()) return sets;
  const View& first = frames.front().state.view;
  PictureStage items(device.device, first.width, first.height, TargetKind::item);
  CutLister lister;
  Progress progress("item buffers on " + device.name, frames.size());
  for (const FrameRequest& frame : frames) {
    const FrameView view(device.hierarchy.skeleton(), frame.state, injected_frame_rules());
    items.begin(view, frame.number);
    items.draw(lister.list(view));
    sets.push_back(owners(items.target(), frame.state.samples));
    progress.advance();
    end_if_asked("measure speed");
  }
  return sets;
}

std::unique_ptr<SpeedMethod> make_triptych_method(const SpeedDevice& device,
                                                  std::span<const FrameRequest> frames) {
  return std::make_unique<TriptychMethod>(device, frames);
}

std::unique_ptr<SpeedMethod> make_frustum_method(const SpeedDevice& device,
                                                 std::span<const FrameRequest> frames) {
  return std::make_unique<FrustumMethod>(device, frames);
}

std::unique_ptr<SpeedMethod> make_frustum_hidepth_method(const SpeedDevice& device,
                                                         std::span<const FrameRequest> frames) {
  return std::make_unique<FrustumHidepthMethod>(device, frames);
}

std::unique_ptr<SpeedMethod> make_oracle_method(const SpeedDevice& device,
                                                std::span<const FrameRequest> frames,
                                                std::span<const VisibleSet> owners) {
  return std::make_unique<OracleMethod>(device, frames, owners);
}

}  // namespace triptych
