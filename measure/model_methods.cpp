#include "measure/model_methods.hpp"

#include "base/clock.hpp"
#include "measure/primary_rays.hpp"
#include "render/flat_model_pass.hpp"

namespace triptych {

namespace {

class EverythingMethod final : public SpeedMethod {
 public:
  EverythingMethod(const FlatModel& model, const Skeleton& skeleton, std::span<const FrameRequest> frames)
      : model_(model),
        skeleton_(skeleton),
        frames_(frames),
        pass_(make_gl_flat_model_pass(model, frames.front().state.view.width,
                                      frames.front().state.view.height)) {}

  std::string name() const override { return "everything"; }
  std::string device() const override { return "gl"; }
  void draw(size_t frame) override {
    const Stopwatch stopwatch;
    pass_->draw(FrameView(skeleton_, frames_[frame].state));
    draw_ms_ = stopwatch.milliseconds();
  }
  std::vector<SpeedStage> stages() const override { return {{"draw", draw_ms_}}; }
  uint64_t drawn_triangles() const override { return model_.triangle_count(); }

 private:
  const FlatModel& model_;
  const Skeleton& skeleton_;
  std::span<const FrameRequest> frames_;
  std::unique_ptr<FlatModelPass> pass_;
  double draw_ms_ = 0;
};

class EmbreeMethod final : public SpeedMethod {
 public:
  EmbreeMethod(const FlatModel& model, std::span<const FrameRequest> frames,
               std::unique_ptr<PrimaryRays> rays)
      : model_(model), frames_(frames), rays_(std::move(rays)) {}

  std::string name() const override { return "embree"; }
  std::string device() const override { return ""; }
  void draw(size_t frame) override {
    const Stopwatch stopwatch;
    const FrameState& state = frames_[frame].state;
    rays_->draw(state.view, state.section, state.samples);
    rays_ms_ = stopwatch.milliseconds();
  }
  std::vector<SpeedStage> stages() const override { return {{"rays", rays_ms_}}; }
  uint64_t drawn_triangles() const override { return model_.triangle_count(); }

 private:
  const FlatModel& model_;
  std::span<const FrameRequest> frames_;
  std::unique_ptr<PrimaryRays> rays_;
  double rays_ms_ = 0;
};

}  // namespace

std::unique_ptr<SpeedMethod> make_everything_method(const FlatModel& model, const Skeleton& skeleton,
                                                    std::span<const FrameRequest> frames) {
  return std::make_unique<EverythingMethod>(model, skeleton, frames);
}

std::unique_ptr<SpeedMethod> make_embree_method(const FlatModel& model, std::span<const FrameRequest> frames,
                                                uint64_t max_tree_bytes) {
  std::unique_ptr<PrimaryRays> rays = PrimaryRays::build(model, max_tree_bytes);
  return rays ? std::make_unique<EmbreeMethod>(model, frames, std::move(rays)) : nullptr;
}

}  // namespace triptych
