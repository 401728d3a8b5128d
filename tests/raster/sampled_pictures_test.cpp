// With samples and edges, too, the picture is a function of pack and frame state.
#include "base/hashing.hpp"
#include "base/threads.hpp"
#include "lod/cut.hpp"
#include "raster/instruction_set.hpp"
#include "raster/raster_device.hpp"
#include "residency/load_on_demand.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

class RasterSamples : public testing::TestWithParam<std::string> {
 protected:
  /// Of some frames of the path.
  std::vector<std::vector<uint8_t>> pictures(bool backwards = false, const RasterOptions& options = {}) {
    LoadOnDemand residency(pack);
    const auto device = make_raster_device(pack.skeleton(), representation, residency, options);
    const auto target = device->make_target(TargetKind::color, width, height);
    std::vector<std::vector<uint8_t>> result;
    const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
    const uint32_t counts[] = {4, 1, 8, 16};
    for (size_t i = 2; i < views.size(); i += 9) {
      const FrameView view(pack.skeleton(), {views[i], 1, counts[i % 4], i % 3 != 0});
      target->begin(view);
      std::vector<DrawableId> drawables = select_cut(view).drawables;
      if (backwards) std::reverse(drawables.begin(), drawables.end());
      for (size_t first = 0, count = backwards ? 3 : drawables.size(); first < drawables.size();
           first += count)
        target->draw(std::span(drawables).subspan(first, std::min(count, drawables.size() - first)));
      result.push_back(target->read_colors());
    }
    return result;
  }

  static constexpr int width = 96, height = 73;
  const Pack& pack = scenes::pack(GetParam());
  Hierarchy hierarchy{pack.skeleton()};
  LevelsRepresentation representation{hierarchy};
};

TEST_P(RasterSamples, give_the_same_picture_whatever_order_threads_instructions_and_numbers) {
  set_thread_count(1);
  force_instruction_set(InstructionSet::scalar);
  const auto expected = pictures();
  for (const InstructionSet set : instruction_sets_here()) {
    force_instruction_set(set);
    EXPECT_EQ(expected, pictures()) << instruction_set_name(set);
  }
  force_instruction_set(std::nullopt);
  for (const unsigned threads : {2u, 5u}) {
    set_thread_count(threads);
    EXPECT_EQ(expected, pictures(true)) << threads;
  }
  set_thread_count(0);
  EXPECT_EQ(expected, pictures(false, {.max_slots = 1}));
  EXPECT_FALSE(std::ranges::all_of(expected, [&](const auto& picture) { return picture == expected[0]; }));
}

INSTANTIATE_TEST_SUITE_P(Scenes, RasterSamples, testing::Values("room", "coplanar", "slivers", "painted"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
