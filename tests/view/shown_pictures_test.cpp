// Pictures of the rasteriser, as a window on a display shows them.
#include "lod/cut.hpp"
#include "nodes/pack_device.hpp"
#include "tests/support/scenes.hpp"
#include "tests/view/display.hpp"
#include "tests/view/screen.hpp"
#include "view/window.hpp"

#include <algorithm>
#include <cstring>

namespace triptych {
namespace {

class ShownPictures : public testing::Test {
 protected:
  /// A target of the size with a picture of the room in it.
  std::unique_ptr<FrameTarget> picture(int width, int height) {
    const Skeleton& skeleton = pack.skeleton();
    auto target = device.device().make_target(TargetKind::color, width, height);
    const FrameView view(skeleton, {scenes::path(skeleton, width, height).front(), 1});
    std::vector<DrawableId> cut = select_cut(view).drawables;
    sort_by_rank(skeleton, view.cell, cut);
    target->begin(view);
    target->draw(cut);
    target->finish();
    return target;
  }

  test::Display display;
  const Pack& pack = scenes::pack("room");
  PackDevice device{pack, {DeviceKind::cpu}};
};

TEST_F(ShownPictures, are_those_of_the_target_from_one_size_to_the_next) {
  for (const auto& [width, height] : {std::pair(321, 123), {320, 240}}) {
    Window window({.title = "shown", .width = width, .height = height, .context = {}});
    ASSERT_EQ(window.width(), width);
    window.poll(0);
    const auto target = picture(width, height);
    const std::vector<uint8_t> colors = target->read_colors();
    EXPECT_NE(std::adjacent_find(colors.begin(), colors.end(), std::not_equal_to<>()), colors.end());
    EXPECT_TRUE(window.show(*target).empty());
    EXPECT_EQ(test::pixels_of_window(width, height), colors) << width << "x" << height;
    EXPECT_EQ(window.show(*target, true), colors);
  }
}

TEST_F(ShownPictures, of_another_size_than_the_window_lie_in_its_lower_left_corner) {
  constexpr int width = 320, height = 240;
  Window window({.title = "shown", .width = width, .height = height, .context = {}});
  window.poll(0);
  const auto target = picture(200, 300);
  const std::vector<uint8_t> colors = target->read_colors(), shown = window.show(*target, true);
  ASSERT_EQ(shown.size(), size_t{4} * width * height);
  for (size_t row = 0; row < height; ++row) {
    EXPECT_EQ(std::memcmp(&shown[row * width * 4], &colors[row * 200 * 4], size_t{200} * 4), 0) << row;
  }
}

}  // namespace
}  // namespace triptych
