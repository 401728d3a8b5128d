// The seams of strategy and device, proven by users of no other use: a strategy that chooses levels itself,
// one that never tests, and a device without a graphics card.
#include "base/error.hpp"
#include "measure/allocation_count.hpp"
#include "nodes/local_pipeline.hpp"
#include "nodes/pack_strategy.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <type_traits>

namespace triptych {
namespace {

// An approximate strategy cannot be handed to what claims exactness, and nothing is a strategy without a
// guarantee.
static_assert(!std::is_convertible_v<ApproximateStrategy*, ExactStrategy*>);
static_assert(!std::is_constructible_v<Strategy>);

/// A picture of drawables: each covers the pixels of its bounds' middle; it answers that every third test
/// fails.
class FakeTarget final : public FrameTarget {
 public:
  FakeTarget(TargetKind kind, int width, int height) : kind_(kind), width_(width), height_(height) {}
  int width() const override { return width_; }
  int height() const override { return height_; }
  TargetKind kind() const override { return kind_; }
  void begin(const FrameView& view) override {
    EXPECT_EQ(view.view().width, width_);
    drawn_.clear();
    tests_ = 0;
  }
  void draw(std::span<const DrawableId> drawables) override {
    drawn_.insert(drawn_.end(), drawables.begin(), drawables.end());
  }
  void test(std::span<const ScreenRectangle>, std::span<const uint32_t> ends, uint32_t,
            std::span<uint8_t> visible) override {
    for (size_t i = 0; i < ends.size(); ++i) visible[i] = ++tests_ % 3 != 0;
  }
  void finish() override {}
  uint64_t drawn_triangles() const override { return drawn_.size(); }
  void draw_lines(std::span<const ScreenLine>) override {}
  std::vector<uint8_t> read_colors() const override { return {}; }
  std::vector<uint32_t> read_items(uint32_t) const override { return {}; }
  bool copy_to_window(int, int) const override { return false; }

  const std::vector<DrawableId>& drawn() const { return drawn_; }
  size_t tests() const { return tests_; }

 private:
  TargetKind kind_;
  int width_, height_;
  std::vector<DrawableId> drawn_;
  size_t tests_ = 0;
};

class FakeDevice final : public Device {
 public:
  explicit FakeDevice(bool order_matters = true) : order_matters_(order_matters) {}
  std::unique_ptr<FrameTarget> make_target(TargetKind kind, int width, int height) override {
    ++targets_;
    return std::make_unique<FakeTarget>(kind, width, height);
  }
  bool order_matters() const override { return order_matters_; }
  size_t targets() const { return targets_; }
  const DeviceNames& names() const override { return names_; }
  void set_geometry_cap(uint64_t) override {}
  void set_missing(const MissingChunks&) override {}
  GeometryUse geometry_use() const override { return {}; }
  bool has_chunk(uint32_t) const override { return true; }
  bool is_damaged(uint32_t) const override { return false; }

 private:
  DeviceNames names_{"nobody", "fake", "1"};
  bool order_matters_;
  size_t targets_ = 0;
};

/// Chooses levels itself: the finest of everything in the frustum, but no more than so many.
class NearestOnly final : public ApproximateStrategy {
 public:
  NearestOnly(const Hierarchy& hierarchy, size_t count) : hierarchy_(hierarchy), count_(count) {}
  const std::string& name() const override {
    static const std::string name = "nearest";
    return name;
  }
  std::string may_miss() const override { return "all but the nearest drawables"; }
  const CullResult& run(const FrameView& view, const VisibleSet& previous, FrameTarget&,
                        CullSink& sink) override {
    const Skeleton& skeleton = hierarchy_.skeleton();
    ordered_.clear();
    for (const SceneNode& node : skeleton.scene_nodes) {
      if (node.child_count == 0 && !view.eye_space.bounds(node.box).outside)
        ordered_.push_back(node.first_drawable);
    }
    sort_by_rank(skeleton, view.cell, ordered_);
    ordered_.resize(std::min(ordered_.size(), count_));
    result_.clear();
    result_.visible = ordered_;
    std::sort(result_.visible.begin(), result_.visible.end());
    sink.take({everything_decided, difference(previous, result_.visible)});
    return result_;
  }
  const std::vector<DrawableId>& ordered() const { return ordered_; }

 private:
  const Hierarchy& hierarchy_;
  size_t count_;
  std::vector<DrawableId> ordered_;
  CullResult result_;
};

class Seams : public testing::Test {
 protected:
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  const Hierarchy hierarchy{skeleton};
  const std::vector<View> views = scenes::path(skeleton, 96, 64);
  const StrategyOptions with_cells = choose_strategy(scenes::pack("room"), StrategyKind::portals).options;
  FakeDevice device;

  LocalPipelineOptions options() const {
    LocalPipelineOptions options;
    options.width = 96;
    options.height = 64;
    return options;
  }
  FrameRequest frame(uint32_t number) const {
    return {number, {views[number % views.size()], scenes::pixel_error(number)}};
  }
  static const FakeTarget& fake(const FrameTarget& target) { return dynamic_cast<const FakeTarget&>(target); }
};

TEST_F(Seams, a_strategy_that_chooses_levels_itself_is_drawn_in_draw_rank_order_and_leaves_or_idle) {
  NearestOnly strategy(hierarchy, 7);
  LocalPipeline pipeline(hierarchy, device, strategy, options());
  for (uint32_t number = 0; number < 12; ++number) {
    const FrameRecord& record = pipeline.draw(frame(number));
    EXPECT_EQ(fake(pipeline.target()).drawn(), strategy.ordered());
    EXPECT_EQ(record.visible_count, strategy.ordered().size());
    EXPECT_EQ(record.tests, 0u);
  }
}

TEST_F(Seams, a_strategy_that_never_tests_draws_the_whole_cut) {
  const auto strategy = make_exact_strategy(StrategyKind::frustum, hierarchy);
  LocalPipeline pipeline(hierarchy, device, *strategy, options());
  for (uint32_t number = 0; number < 12; ++number) {
    pipeline.draw(frame(number));
    EXPECT_EQ(fake(pipeline.target()).drawn(),
              select_cut(FrameView(skeleton, frame(number).state)).drawables);
  }
}

TEST_F(Seams, a_strategy_that_tests_takes_any_device_s_answers) {
  const auto strategy = make_exact_strategy(StrategyKind::occlusion, hierarchy);
  LocalPipeline pipeline(hierarchy, device, *strategy, options());
  size_t tests = 0;
  for (uint32_t number = 0; number < 12; ++number) {
    const FrameRecord& record = pipeline.draw(frame(number));
    tests += record.tests;
    std::vector<DrawableId> drawn = fake(pipeline.target()).drawn();
    std::sort(drawn.begin(), drawn.end());
    EXPECT_EQ(drawn, record.visible);
    const VisibleDelta beyond = difference(
        [&] {
          VisibleSet cut = select_cut(FrameView(skeleton, frame(number).state)).drawables;
          std::sort(cut.begin(), cut.end());
          return cut;
        }(),
        record.visible);
    EXPECT_TRUE(beyond.added.empty()) << "is not in the cut";
  }
  EXPECT_GT(tests, 0u);
}

TEST_F(Seams, where_order_does_not_matter_the_representation_becomes_the_picture) {
  FakeDevice one_pass(false);
  const auto strategy = make_exact_strategy(StrategyKind::occlusion, hierarchy);
  LocalPipeline pipeline(hierarchy, one_pass, *strategy, options());
  EXPECT_EQ(one_pass.targets(), 1u);
  for (uint32_t number = 0; number < 12; ++number) {
    const FrameRecord& record = pipeline.draw(frame(number));
    VisibleSet drawn = fake(pipeline.target()).drawn();
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    EXPECT_TRUE(difference(drawn, record.visible).added.empty()) << "shows and was not drawn";
    EXPECT_GT(fake(pipeline.target()).tests(), 0u) << "what was tested against is the picture";
    VisibleSet cut = select_cut(FrameView(skeleton, frame(number).state)).drawables;
    std::sort(cut.begin(), cut.end());
    EXPECT_TRUE(difference(cut, drawn).added.empty()) << "is not of the cut";
  }
}

TEST_F(Seams, strategies_change_from_one_frame_to_the_next) {
  const auto occlusion = make_exact_strategy(StrategyKind::occlusion, hierarchy);
  const auto frustum = make_exact_strategy(StrategyKind::frustum, hierarchy);
  LocalPipeline pipeline(hierarchy, device, *occlusion, options());
  pipeline.draw(frame(0));
  pipeline.set_strategy(*frustum);
  const size_t whole = pipeline.draw(frame(0)).visible_count;
  EXPECT_EQ(whole, select_cut(FrameView(skeleton, frame(0).state)).drawables.size());
  pipeline.set_strategy(*occlusion);
  EXPECT_LE(pipeline.draw(frame(0)).visible_count, whole);
}

TEST_F(Seams, each_strategy_has_the_name_that_it_is_listed_under_and_one_guarantee) {
  for (const auto& [name, kind] : strategy_names()) {
    const auto strategy = make_strategy(kind, hierarchy, with_cells);
    EXPECT_EQ(strategy->name(), name);
    const auto* const approximate = dynamic_cast<const ApproximateStrategy*>(strategy.get());
    EXPECT_NE(dynamic_cast<const ExactStrategy*>(strategy.get()) != nullptr, approximate != nullptr) << name;
    EXPECT_EQ(approximate != nullptr, kind == StrategyKind::approximate);
    if (approximate != nullptr) {
      EXPECT_NE(approximate->may_miss().find("fewer than 4 pixels"), std::string::npos);
      EXPECT_THROW(make_exact_strategy(kind, hierarchy), Error);
    } else {
      EXPECT_EQ(make_exact_strategy(kind, hierarchy, with_cells)->name(), name);
    }
  }
}

TEST_F(Seams, after_a_round_frames_allocate_nothing) {
  if (!allocations_are_counted()) GTEST_SKIP() << "the allocator is the sanitizer's";
  for (const auto& [name, kind] : strategy_names()) {
    const auto strategy = make_strategy(kind, hierarchy, with_cells);
    LocalPipeline pipeline(hierarchy, device, *strategy, options());
    std::vector<FrameRequest> frames;
    for (uint32_t number = 0; number < views.size(); ++number) frames.push_back(frame(number));
    for (int round = 0; round < 2; ++round) {
      for (const FrameRequest& request : frames) pipeline.draw(request);
    }
    const uint64_t before = allocation_count();
    for (const FrameRequest& request : frames) pipeline.draw(request);
    EXPECT_EQ(allocation_count() - before, 0u) << strategy->name();
  }
  const uint64_t before = allocation_count();
  volatile size_t size = 100;
  const std::vector<int> some(size);
  EXPECT_GT(allocation_count(), before) << "nothing is counted";
}

}  // namespace
}  // namespace triptych
