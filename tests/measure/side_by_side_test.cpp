#include "measure/side_by_side.hpp"

#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <gtest/gtest.h>

namespace triptych {

TEST(SideBySide, packs_in_turn_give_the_same_frames_as_each_alone_in_every_round) {
  const Pack& room = scenes::pack("room");
  const Pack& other = scenes::pack("coplanar");
  std::vector<FrameRequest> requests;
  for (const View& view : scenes::random_views(room.skeleton(), 64, 48, 5, 3))
    requests.push_back({static_cast<uint32_t>(requests.size()), {view, 1}});
  const auto both = run_side_by_side(std::array<const Pack*, 2>{&room, &other}, requests, test::device(), 2);
  const auto alone = run_side_by_side(std::array<const Pack*, 1>{&room}, requests, test::device(), 1);
  ASSERT_EQ(both.size(), 2u);
  for (const SideBySideRun& run : both) {
    ASSERT_EQ(run.frames.size(), 10u);
    EXPECT_EQ(run.comparison.frames_compared, 5u);
    EXPECT_EQ(run.comparison.identical_frames, 5u);
    for (size_t i = 0; i < 5; ++i) {
      EXPECT_EQ(run.frames[i].visible, run.frames[i + 5].visible);
      EXPECT_EQ(run.frames[i].tests, run.frames[i + 5].tests);
    }
  }
  for (size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(both[0].frames[i].visible, alone[0].frames[i].visible);
    EXPECT_EQ(both[0].frames[i].picture_hash, alone[0].frames[i].picture_hash);
  }
  EXPECT_NE(both[0].frames[0].drawn_triangles, both[1].frames[0].drawn_triangles);
}

}  // namespace triptych
