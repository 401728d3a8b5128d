// Nothing visible is ever culled: what is drawn of the visible set is the picture of the whole cut, pixel for
// pixel.
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

struct Size {
  int width, height;
};

class CulledPictures : public testing::TestWithParam<std::tuple<std::string, Size>> {
 protected:
  const Pack& pack = scenes::pack(std::get<0>(GetParam()));
  const Size size = std::get<1>(GetParam());
};

TEST_P(CulledPictures, equal_the_un_culled_ones_in_every_pixel) {
  // Of OpenGL both ways to test boxes.
  DeviceOptions other_way = test::device();
  other_way.test = other_way.test == TestKind::storage ? TestKind::queries : TestKind::storage;
  Rig rig(pack, size.width, size.height), other(pack, size.width, size.height, other_way);
  LocalPipeline items(pack, {.width = size.width,
                             .height = size.height,
                             .cull = StrategyKind::frustum,
                             .device = test::device(),
                             .item_buffer = true});
  const std::vector<View> views = scenes::path(pack.skeleton(), size.width, size.height);
  uint64_t seen = 0, drawn = 0, cut = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    SCOPED_TRACE(testing::Message() << "frame " << i);
    const FrameRequest request{static_cast<uint32_t>(i), {views[i], scenes::pixel_error(i)}};
    const Rig::Frame frame = rig.draw(request);
    EXPECT_EQ(frame.differing_pixels, 0u);
    EXPECT_EQ(other.draw(request).record.visible, frame.record.visible)
        << "queries and the storage test disagree";
    items.draw(request);
    const VisibleSet truth = owners(items.target().read_items());
    EXPECT_EQ(difference(frame.record.visible, truth).added, VisibleSet())
        << "visible drawables that were culled";
    seen += truth.size();
    drawn += frame.record.visible.size();
    cut += frame.record.cut_drawables;
  }
  RecordProperty("drawables_seen", std::to_string(seen));
  RecordProperty("drawables_drawn", std::to_string(drawn));
  RecordProperty("drawables_in_cuts", std::to_string(cut));
  if (std::get<0>(GetParam()) == "room") {
    EXPECT_LT(drawn, cut * 3 / 4) << "what stands behind walls is culled";
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CulledPictures,
                         testing::Combine(testing::ValuesIn(scenes::names()),
                                          testing::Values(Size{512, 512}, Size{641, 479})),
                         [](const auto& parameter) {
                           return std::get<0>(parameter.param) + "_" +
                                  std::to_string(std::get<1>(parameter.param).width);
                         });

class CulledInBatches : public testing::TestWithParam<std::string> {};

TEST_P(CulledInBatches, of_any_size_pictures_equal_the_un_culled_ones) {
  const Pack& pack = scenes::pack(GetParam());
  for (const size_t batch : {size_t{1}, size_t{7}, size_t{100000}}) {
    const CullOptions batches{.batch = batch, .min_batch = batch};
    Rig rig(pack, 160, 120, test::device(), batches);
    const std::vector<View> views = scenes::random_views(pack.skeleton(), 160, 120, 12, 5);
    for (size_t i = 0; i < views.size(); ++i) {
      EXPECT_EQ(rig.draw({static_cast<uint32_t>(i), {views[i], scenes::pixel_error(i)}}).differing_pixels, 0u)
          << "frame " << i << " in batches of " << batch;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, CulledInBatches, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

TEST(CulledPicture, of_the_first_frame_and_after_forgetting_is_the_un_culled_one_too) {
  const Pack& pack = scenes::pack("room");
  LocalPipeline culled(pack, {.device = test::device()}),
      whole(pack, {.cull = StrategyKind::frustum, .device = test::device()});
  for (const View& view : scenes::random_views(pack.skeleton(), 512, 512, 6, 9)) {
    culled.forget();
    const FrameRecord record = culled.draw({0, view, 1});
    whole.draw({0, view, 1});
    EXPECT_EQ(differing_pixels(culled.target().read_colors(), whole.target().read_colors()), 0u);
    EXPECT_EQ(record.added, record.visible.size());
  }
}

TEST(CulledPicture, shows_what_the_picture_of_the_whole_model_shows) {
  const Pack& pack = scenes::pack("world");
  LocalPipeline frustum(pack, {.cull = StrategyKind::frustum, .device = test::device()}),
      all(pack, {.cull = StrategyKind::none, .device = test::device()});
  for (const View& view : scenes::random_views(pack.skeleton(), 512, 512, 8, 3)) {
    const FrameRecord cut = frustum.draw({0, view, 1});
    EXPECT_GE(all.draw({0, view, 1}).visible.size(), cut.visible.size());
    EXPECT_EQ(differing_pixels(frustum.target().read_colors(), all.target().read_colors()), 0u);
  }
}

}  // namespace
}  // namespace triptych
