// What the approximate strategy leaves out owns fewer pixels than its threshold; and the counting of pixels
// that this rests on, by either device.
#include "nodes/local_pipeline.hpp"
#include "tests/support/pictures.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/drawable_bounds.hpp"
#include "visibility/occlusion_strategy.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <memory>

namespace triptych {
namespace {

constexpr int width = 320, height = 240;

LocalPipelineOptions options(StrategyKind cull, uint32_t min_pixels = 1) {
  return {.width = width, .height = height, .cull = cull, .min_pixels = min_pixels, .device = test::device()};
}

std::map<DrawableId, uint32_t> owned_pixels(const FrameTarget& target) {
  std::map<DrawableId, uint32_t> owned;
  for (const uint32_t item : target.read_items()) {
    if (item > 0) ++owned[item - 1];
  }
  return owned;
}

class ApproximatePictures : public testing::TestWithParam<std::string> {
 protected:
  FrameRequest frame(size_t i) const {
    return {static_cast<uint32_t>(i), {views[i], scenes::pixel_error(i)}};
  }
  /// Of the un-culled picture.
  std::map<DrawableId, uint32_t> owners_of(size_t i) {
    whole.draw(frame(i));
    return owned_pixels(whole.target());
  }
  static LocalPipelineOptions with_items() {
    LocalPipelineOptions items = options(StrategyKind::frustum);
    items.item_buffer = true;
    return items;
  }

  const Pack& pack = scenes::pack(GetParam());
  const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
  LocalPipeline whole{pack, with_items()};
};

TEST_P(ApproximatePictures, with_a_threshold_of_one_pixel_are_those_of_the_exact_strategy) {
  LocalPipeline exact(pack, options(StrategyKind::occlusion)),
      approximate(pack, options(StrategyKind::approximate, 1));
  for (size_t i = 0; i < views.size(); ++i) {
    const FrameRecord &expected = exact.draw(frame(i)), &record = approximate.draw(frame(i));
    EXPECT_EQ(record.visible, expected.visible) << "frame " << i;
    EXPECT_EQ(record.tests, expected.tests);
    EXPECT_EQ(test::differing_pixels(exact.target().read_colors(), approximate.target().read_colors()), 0u);
  }
}

TEST_P(ApproximatePictures, lose_only_what_owns_fewer_pixels_than_the_threshold) {
  // Of OpenGL both ways to count.
  DeviceOptions other_way = test::device();
  other_way.test = other_way.test == TestKind::storage ? TestKind::queries : TestKind::storage;
  struct Run {
    uint32_t min_pixels;
    std::unique_ptr<LocalPipeline> own, other;
  };
  std::vector<Run> runs;
  for (const uint32_t min_pixels : {4u, 60u, 1000000u}) {
    LocalPipelineOptions wanted = options(StrategyKind::approximate, min_pixels);
    Run& run = runs.emplace_back(Run{min_pixels, std::make_unique<LocalPipeline>(pack, wanted), nullptr});
    wanted.device = other_way;
    if (test::on_gl()) run.other = std::make_unique<LocalPipeline>(pack, wanted);
  }
  size_t lost = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    const std::map<DrawableId, uint32_t> owners = owners_of(i);
    for (const Run& run : runs) {
      SCOPED_TRACE(testing::Message() << "frame " << i << ", at least " << run.min_pixels << " pixels");
      const VisibleSet& visible = run.own->draw(frame(i)).visible;
      if (run.other) {
        EXPECT_EQ(run.other->draw(frame(i)).visible, visible) << "queries and the storage test disagree";
      }
      for (const auto& [id, pixels] : owners) {
        if (std::binary_search(visible.begin(), visible.end(), id)) continue;
        EXPECT_LT(pixels, run.min_pixels) << "drawable " << id;
        ++lost;
      }
    }
  }
  EXPECT_GT(lost, 0u) << "nothing was lost: it is not approximate";
}

TEST_P(ApproximatePictures, never_lose_a_drawable_of_exactly_as_many_pixels) {
  const Hierarchy hierarchy(pack.skeleton());
  PackDevice device(pack, test::device());
  for (size_t i = 0; i < views.size(); i += 3) {
    const std::map<DrawableId, uint32_t> owners = owners_of(i);
    std::vector<std::pair<uint32_t, DrawableId>> by_size;
    for (const auto& [id, pixels] : owners) by_size.emplace_back(pixels, id);
    std::sort(by_size.begin(), by_size.end());
    for (size_t j = 0; j < by_size.size(); j += by_size.size() / 3 + 1) {
      const auto [pixels, id] = by_size[j];
      ApproximateOcclusionStrategy strategy(hierarchy, {}, pixels);
      LocalPipeline approximate(hierarchy, device.device(), strategy, options(StrategyKind::approximate));
      // From an empty representation, and from what was visible one frame ago.
      for (int round = 0; round < 2; ++round) {
        const VisibleSet& visible = approximate.draw(frame(i)).visible;
        EXPECT_TRUE(std::binary_search(visible.begin(), visible.end(), id))
            << "frame " << i << ": drawable " << id << " of " << pixels << " pixels";
      }
    }
  }
}

/// Whether the rectangle reaches the centre of this pixel.
bool reaches(const ScreenRectangle& rectangle, int x, int y) {
  const double column = (2 * x + 1.0) / width - 1, row = (2 * y + 1.0) / height - 1;
  ScreenRectangle unbounded = rectangle;
  unbounded.left = unbounded.bottom = -1;
  unbounded.right = unbounded.top = 1;
  return column >= double{rectangle.left} && column <= double{rectangle.right} &&
         row >= double{rectangle.bottom} && row <= double{rectangle.top} &&
         unbounded.covers(static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1,
                          static_cast<float>(2 * y + 1) / static_cast<float>(height) - 1);
}

TEST_P(ApproximatePictures, rest_on_counts_of_the_pixels_that_rectangles_cover) {
  const Hierarchy hierarchy(pack.skeleton());
  PackDevice device(pack, test::device());
  const auto target = device.device().make_target(TargetKind::depth_only, width, height);
  size_t counted = 0;
  for (size_t i = 0; i < views.size(); i += 6) {
    const FrameView view(pack.skeleton(), frame(i).state);
    target->begin(view);  // and draw nothing: all that is covered shows
    const BoxProjector projector(view, target->margins());
    std::vector<ScreenRectangle> rectangles;
    for (const DrawableId id : select_cut(view).drawables) {
      rectangles.clear();
      append_drawable_bounds(hierarchy, projector, id, rectangles);
      if (rectangles.empty()) continue;
      uint32_t pixels = 0;
      for (const ScreenRectangle& rectangle : rectangles) {
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) pixels += reaches(rectangle, x, y);
        }
      }
      // OpenGL snaps corners, so that pixels at outlines may be counted or not: a row and a column of each.
      uint32_t slack = 0;
      for (const ScreenRectangle& rectangle : rectangles) {
        if (!test::on_gl()) break;
        slack += static_cast<uint32_t>((rectangle.right - rectangle.left) * width / 2 +
                                       (rectangle.top - rectangle.bottom) * height / 2) +
                 8;
      }
      if (pixels < slack + 2) continue;
      const std::array ends = {static_cast<uint32_t>(rectangles.size())};
      std::array<uint8_t, 1> answer{};
      target->test(rectangles, ends, pixels - slack, answer);
      EXPECT_EQ(answer[0], 1) << "frame " << i << ", " << pixels << " pixels";
      target->test(rectangles, ends, pixels + slack + 1, answer);
      EXPECT_EQ(answer[0], 0) << "frame " << i << ", " << pixels << " pixels";
      if (++counted % 12 == 0) break;
    }
  }
  EXPECT_GT(counted, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, ApproximatePictures, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
