// The device as a whole: the same picture whatever the order, the batches, the threads, the surroundings.
#include "base/threads.hpp"
#include "lod/cut.hpp"
#include "raster/raster_device.hpp"
#include "residency/load_on_demand.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <cfenv>
#include <gtest/gtest.h>
#include <xmmintrin.h>

namespace triptych {
namespace {

using scenes::Random;

struct Picture {
  std::vector<uint8_t> colors;
  std::vector<uint32_t> items;
  bool operator==(const Picture&) const = default;
};

class RasterDevice : public testing::TestWithParam<std::string> {
 protected:
  explicit RasterDevice(int of_width = 160, int of_height = 121)
      : pack(scenes::pack(GetParam())),
        hierarchy(pack.skeleton()),
        representation(hierarchy),
        width(of_width),
        height(of_height),
        views(scenes::path(pack.skeleton(), width, height)) {}

  /// The cuts of some frames of the path, drawn as `draw` does.
  template <typename Draw>
  std::vector<Picture> pictures(const Draw& draw, const RasterOptions& options = {}) {
    LoadOnDemand residency(pack);
    const auto device = make_raster_device(pack.skeleton(), representation, residency, options);
    const auto target = device->make_target(TargetKind::color_and_item, width, height);
    std::vector<Picture> result;
    for (size_t i = 0; i < views.size(); i += 3) {
      const FrameView view(pack.skeleton(), {views[i], scenes::pixel_error(i)});
      target->begin(view);
      std::vector<DrawableId> drawables = select_cut(view).drawables;
      sort_by_rank(pack.skeleton(), view.cell, drawables);
      draw(*target, drawables);
      target->finish();
      result.push_back({target->read_colors(), target->read_items()});
    }
    return result;
  }
  static void at_once(FrameTarget& target, const std::vector<DrawableId>& drawables) {
    target.draw(drawables);
  }

  const Pack& pack;
  Hierarchy hierarchy;
  LevelsRepresentation representation;
  int width, height;
  std::vector<View> views;
};

TEST_P(RasterDevice, draws_the_same_whatever_the_order_and_the_batches) {
  const auto expected = pictures(at_once);
  EXPECT_EQ(expected, pictures([](FrameTarget& target, std::vector<DrawableId> drawables) {
              std::reverse(drawables.begin(), drawables.end());
              target.draw(drawables);
            }));
  Random random(1);
  EXPECT_EQ(expected, pictures([&](FrameTarget& target, std::vector<DrawableId> drawables) {
              for (size_t i = drawables.size(); i > 1; --i)
                std::swap(drawables[i - 1], drawables[random.index(i)]);
              for (size_t first = 0; first < drawables.size();) {
                const size_t count = std::min(drawables.size() - first, size_t{1} + random.index(5));
                target.draw(std::span(drawables).subspan(first, count));
                first += count;
              }
              target.draw(drawables);  // what was drawn is not drawn again
            }));
  const auto empty = [](const Picture& picture) {
    return std::all_of(picture.items.begin(), picture.items.end(), [](uint32_t item) { return item == 0; });
  };
  EXPECT_FALSE(std::all_of(expected.begin(), expected.end(), empty));
}

TEST_P(RasterDevice, draws_the_same_with_any_number_of_threads) {
  const auto expected = pictures(at_once);
  for (const unsigned threads : {1u, 2u, 3u, 7u}) {
    set_thread_count(threads);
    EXPECT_EQ(expected, pictures(at_once)) << threads;
  }
  set_thread_count(0);
}

TEST_P(RasterDevice, draws_the_same_where_numbers_of_triangles_run_out) {
  const auto expected = pictures(at_once);
  EXPECT_EQ(expected, pictures(at_once, {.max_slots = 1}));
}

TEST_P(RasterDevice, draws_the_same_whatever_rounding_the_program_around_it_has_set) {
  const auto expected = pictures(at_once);
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | 0x8040);  // denormals are zero
  std::fesetround(FE_UPWARD);
  const auto found = pictures(at_once);
  std::fesetround(FE_TONEAREST);
  _mm_setcsr(before);
  EXPECT_EQ(expected, found);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterDevice, testing::ValuesIn(scenes::names()));

class RasterSizes : public RasterDevice {
 protected:
  RasterSizes() : RasterDevice(1, 1) {}
};

TEST_P(RasterSizes, pictures_of_any_size_are_the_same_for_one_thread_and_many) {
  for (const auto& [w, h] :
       {std::pair(1, 1), {7, 5}, {641, 9}, {3, 700}, {5000, 200}, {16384, 16}, {16, 16384}}) {
    width = w;
    height = h;
    views = scenes::path(pack.skeleton(), w, h);
    views.resize(std::min<size_t>(views.size(), 10));
    set_thread_count(1);
    const auto expected = pictures(at_once);
    set_thread_count(3);
    EXPECT_EQ(expected, pictures(at_once)) << w << "x" << h;
    set_thread_count(0);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterSizes, testing::Values("room", "coplanar"));

}  // namespace
}  // namespace triptych
