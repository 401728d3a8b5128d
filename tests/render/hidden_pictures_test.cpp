// What is hidden neither shows nor hides anything, under sets that change from frame to frame.
#include "raster/raster_device.hpp"
#include "render/gl_device.hpp"
#include "residency/load_on_demand.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr int width = 64, height = 48;

/// Leaves out what belongs to a hidden object, as the pack says of each placement: another way to the same
/// pictures.
class JudgeRepresentation final : public Representation {
 public:
  JudgeRepresentation(const Hierarchy& hierarchy, const PackObjects& objects)
      : hierarchy_(hierarchy), levels_(hierarchy), objects_(objects) {}

  ObjectSet hidden;
  const std::string& name() const override { return levels_.name(); }
  void begin(const FrameView& view) override { levels_.begin(view); }
  void append(DrawableId id, std::vector<DrawItem>& items) override {
    std::vector<DrawItem> all;
    levels_.append(id, all);
    const auto placements = hierarchy_.placements_of(id);
    uint32_t placement = 0;
    for (const DrawItem& item : all) {
      while (placements[placement].chunk != item.chunk || placements[placement].transform != item.transform)
        ++placement;
      const SourceObjectId object = objects_.object_at(id, placement++, 0);
      if (!std::binary_search(hidden.begin(), hidden.end(), object)) items.push_back(item);
    }
  }

 private:
  const Hierarchy& hierarchy_;
  LevelsRepresentation levels_;
  const PackObjects& objects_;
};

/// Draws full detail with it.
class Judge {
 public:
  Judge(const Pack& pack, const PackObjects& objects)
      : skeleton_(pack.skeleton()),
        hierarchy_(skeleton_),
        representation_(hierarchy_, objects),
        residency_(pack),
        device_(test::on_gl() ? make_gl_device(skeleton_, representation_, residency_, test::device().test)
                              : make_raster_device(skeleton_, representation_, residency_)),
        target_(device_->make_target(TargetKind::color, width, height)) {}

  std::vector<uint8_t> picture(FrameState state) {
    representation_.hidden = state.hiding.objects ? state.hiding.objects->objects() : ObjectSet();
    state.hiding = {};
    const FrameView view(skeleton_, state);
    target_->begin(view);
    target_->draw(select_cut(view).drawables);
    target_->finish();
    return target_->read_colors();
  }

 private:
  const Skeleton& skeleton_;
  Hierarchy hierarchy_;
  JudgeRepresentation representation_;
  LoadOnDemand residency_;
  std::unique_ptr<Device> device_;
  std::unique_ptr<FrameTarget> target_;
};

class HiddenPictures : public testing::TestWithParam<std::string> {
 protected:
  HiddenPictures() : pack(scenes::pack_with_objects(GetParam())), objects(pack.read_objects()) {}

  /// So many frames, each with a set of its own, or the one before.
  std::vector<FrameRequest> frames(size_t count, uint32_t seed) const {
    scenes::Random random(seed);
    const std::vector<View> views = scenes::random_views(pack.skeleton(), width, height, count, seed);
    std::vector<FrameRequest> frames;
    Hiding hiding;
    for (size_t i = 0; i < count; ++i) {
      if (random.index(4) != 0)
        hiding =
            hide(pack.skeleton(), objects, test::random_set(random, objects.source().objects.size()), "test");
      FrameState state{views[i], scenes::pixel_error(i)};
      if (random.index(3) == 0 && i > 0)
        state.view = frames.back().state.view;  // nothing moves but what is there
      state.hiding = hiding;
      frames.push_back({static_cast<uint32_t>(i), state});
    }
    return frames;
  }

  const Pack& pack;
  const PackObjects objects;
};

TEST_P(HiddenPictures, equal_the_un_culled_ones_in_5000_states) {
  // Together with the other scenes; OpenGL takes longer for each.
  const size_t states = (test::on_gl() ? 600 : 5000) / scenes::names().size() + 1;
  Rig rig(pack, width, height);
  LocalPipeline all(pack,
                    {.width = width, .height = height, .cull = StrategyKind::none, .device = test::device()});
  size_t hidden = 0;
  for (const FrameRequest& frame : frames(states, 11)) {
    ASSERT_EQ(rig.draw(frame).differing_pixels, 0u) << "frame " << frame.number;
    hidden += frame.state.hiding.name.count > 0;
    if (frame.number % 16 != 0) continue;
    const std::vector<uint8_t> picture = rig.whole().read_colors();
    all.draw(frame);
    EXPECT_EQ(differing_pixels(all.target().read_colors(), picture), 0u) << "frame " << frame.number;
  }
  EXPECT_GT(hidden, states / 4);
}

TEST_P(HiddenPictures, show_what_is_not_hidden_as_each_placement_says) {
  Judge judge(pack, objects);
  LocalPipeline culled(pack, {.width = width, .height = height, .device = test::device()});
  size_t different = 0;
  for (FrameRequest frame : frames(40, 12)) {
    frame.state.pixel_error = 0;
    culled.draw(frame);
    const std::vector<uint8_t> picture = culled.target().read_colors();
    EXPECT_EQ(differing_pixels(picture, judge.picture(frame.state)), 0u) << "frame " << frame.number;
    FrameState whole = frame.state;
    whole.hiding = {};
    different += differing_pixels(picture, judge.picture(whole)) > 0;
  }
  EXPECT_GT(different, 5u) << "hiding changes hardly any picture";
}

INSTANTIATE_TEST_SUITE_P(Scenes, HiddenPictures, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

class HiddenInRoom : public HiddenPictures {};

TEST_P(HiddenInRoom, what_hides_others_after_it_was_hidden_is_noticed) {
  FrameRules broken;
  broken.hidden_is_gone = false;
  LocalPipeline wrong(pack, {.width = width, .height = height, .device = test::device(), .rules = broken}),
      whole(pack,
            {.width = width, .height = height, .cull = StrategyKind::frustum, .device = test::device()});
  size_t different = 0;
  for (const FrameRequest& frame : frames(60, 13)) {
    wrong.draw(frame);
    whole.draw(frame);
    different += differing_pixels(wrong.target().read_colors(), whole.target().read_colors()) > 0;
  }
  EXPECT_GT(different, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, HiddenInRoom, testing::Values("room"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
