#include "measure/comparison.hpp"

#include "base/hashing.hpp"
#include "nodes/local_pipeline.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <gtest/gtest.h>

namespace triptych {

namespace {

constexpr int width = 96, height = 80;

struct DrawnFrames {
  std::vector<FrameRequest> requests;
  std::vector<FrameRecord> records;
};

DrawnFrames draw_room(const Pack& pack) {
  DrawnFrames run;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  for (const View& view : scenes::random_views(pack.skeleton(), width, height, 12, 7)) {
    run.requests.push_back({static_cast<uint32_t>(run.requests.size()), {view, 1}});
    run.records.push_back(pipeline.draw(run.requests.back()));
    run.records.back().picture_hash =
        hash_values(std::span<const uint8_t>(std::vector<uint8_t>(pipeline.target().read_colors())));
  }
  return run;
}

}  // namespace

TEST(Comparison, frames_drawn_with_culling_equal_the_unculled_ones_and_hold_what_is_visible) {
  const Pack& pack = scenes::pack("room");
  const DrawnFrames run = draw_room(pack);
  const Comparison comparison = compare(pack, test::device(), run.requests, {&run.records}).front();
  EXPECT_EQ(comparison.frames_compared, run.records.size());
  EXPECT_EQ(comparison.identical_frames, run.records.size());
  EXPECT_EQ(comparison.missing_drawables, 0u);
  EXPECT_GT(comparison.visible_drawables, run.records.size());
  EXPECT_GE(comparison.culling_efficiency(), 1);
}

TEST(Comparison, a_wrong_picture_and_a_withheld_drawable_are_found_in_their_run_alone) {
  const Pack& pack = scenes::pack("room");
  const DrawnFrames run = draw_room(pack);
  std::vector<FrameRecord> wrong = run.records;
  wrong[3].picture_hash ^= 1;
  for (FrameRecord& record : wrong) record.visible.clear();
  wrong.pop_back();
  const std::vector<Comparison> comparisons =
      compare(pack, test::device(), run.requests, {&run.records, &wrong});
  EXPECT_TRUE(comparisons[0].different.empty());
  EXPECT_EQ(comparisons[1].different, std::vector<uint32_t>{3});
  EXPECT_EQ(comparisons[1].frames_compared, run.records.size() - 1);
  EXPECT_EQ(comparisons[1].missing_drawables, comparisons[1].visible_drawables);
}

TEST(Comparison, pictures_and_items_of_one_pass_are_those_of_a_pass_each) {
  const Pack& pack = scenes::pack("room");
  PackDevice device(pack, test::device());
  PictureStage both(device.device(), width, height, TargetKind::color_and_item),
      colors(device.device(), width, height), items(device.device(), width, height, TargetKind::item);
  for (const View& view : scenes::random_views(pack.skeleton(), width, height, 12, 7)) {
    const FrameView frame_view(pack.skeleton(), {view, 1});
    const Cut cut = select_cut(frame_view);
    for (PictureStage* stage : {&both, &colors, &items}) {
      stage->begin(frame_view);
      stage->draw(cut.drawables);
    }
    EXPECT_EQ(both.target().read_colors(), colors.target().read_colors());
    EXPECT_EQ(both.target().read_items(), items.target().read_items());
  }
}

}  // namespace triptych
