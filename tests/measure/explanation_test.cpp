#include "measure/explanation.hpp"

#include "base/error.hpp"
#include "base/inject.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

constexpr int width = 160, height = 120;

class Explanation : public testing::Test {
 protected:
  Explanation() {
    const std::vector<View> views = scenes::path(skeleton, width, height);
    for (uint32_t i = 0; i < views.size(); ++i) frames.push_back({i, {views[i], 1.0}});
  }
  ~Explanation() override { clear_injected(); }

  const Pack& pack = scenes::pack("room");
  const Skeleton& skeleton = pack.skeleton();
  std::vector<FrameRequest> frames;
};

TEST_F(Explanation, of_every_drawable_agrees_with_what_the_frame_shows) {
  Explainer explainer(pack, width, height, test::device());
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  std::set<Fate> seen;
  for (size_t i = 0; i < 12; ++i) {
    explainer.draw(frames[i]);
    const VisibleSet visible = pipeline.draw(frames[i]).visible;
    const Cut cut = select_cut(FrameView(skeleton, frames[i].state));
    uint64_t owned = 0;
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      const DrawableExplanation found = explainer.explain(id);
      seen.insert(found.fate);
      owned += found.pixels_owned;
      const bool in_cut = cut.choice[skeleton.drawables[id].scene_node] == id;
      const bool is_visible = std::binary_search(visible.begin(), visible.end(), id);
      EXPECT_EQ(found.fate == Fate::drawn, is_visible) << "frame " << i << " drawable " << id;
      EXPECT_EQ(found.fate == Fate::hidden || found.fate == Fate::between_pixels, in_cut && !is_visible)
          << "frame " << i << " drawable " << id;
      EXPECT_TRUE(found.fate == Fate::drawn || found.pixels_owned == 0);
      if (in_cut) {
        EXPECT_TRUE(found.facts.pixels <= 1 || found.finest_there_is);
        EXPECT_FALSE(found.coarser && found.coarser->pixels <= 1) << "a coarser one would have done";
      }
      EXPECT_FALSE(found.fate == Fate::finer && found.facts.pixels <= 1);
      if (found.fate == Fate::coarser) {
        ASSERT_EQ(found.by.size(), 1u);
        EXPECT_EQ(cut.choice[found.by[0].scene_node], found.by[0].id);
        EXPECT_LE(found.by[0].pixels, 1);
      }
      if (found.fate == Fate::outside_frustum) {
        EXPECT_TRUE(FrameView(skeleton, frames[i].state)
                        .eye_space.bounds(skeleton.scene_nodes[found.decided_at].box)
                        .outside);
      }
      EXPECT_FALSE(found.fate == Fate::hidden && found.by.empty()) << "hidden by nothing";
      for (const DrawableFacts& by : found.by) {
        EXPECT_EQ(cut.choice[by.scene_node], by.id) << "named by something that is not in the cut";
      }
    }
    uint64_t covered = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) covered += explainer.at(x, y).has_value();
    }
    EXPECT_EQ(owned, covered);
  }
  for (const Fate fate : {Fate::drawn, Fate::coarser, Fate::finer, Fate::outside_frustum, Fate::hidden}) {
    EXPECT_TRUE(seen.count(fate)) << "the path never shows fate " << static_cast<int>(fate);
  }
}

TEST_F(Explanation, names_what_owns_the_pixel_counted_from_the_top) {
  Explainer explainer(pack, width, height, test::device());
  explainer.draw(frames[0]);
  LocalPipeline items(pack,
                      {.width = width, .height = height, .device = test::device(), .item_buffer = true});
  items.draw(frames[0]);
  const std::vector<uint32_t> rows = items.target().read_items();
  for (int y = 0; y < height; y += 7) {
    for (int x = 0; x < width; x += 7) {
      const uint32_t item = rows[static_cast<size_t>((height - 1 - y) * width + x)];
      const auto found = explainer.at(x, y);
      EXPECT_EQ(found ? *found + 1 : 0u, item) << x << "," << y;
    }
  }
}

TEST_F(Explanation, tells_a_drawable_that_culling_withheld) {
  inject("withheld-id");
  Explainer explainer(pack, width, height, test::device());
  explainer.draw(frames[0]);
  size_t withheld = 0;
  for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
    withheld += explainer.explain(id).fate == Fate::withheld;
  }
  EXPECT_GT(withheld, 0u);
}

TEST_F(Explanation, of_what_is_not_there_is_an_error) {
  Explainer explainer(pack, width, height, test::device());
  explainer.draw(frames[0]);
  EXPECT_THROW(explainer.at(width, 0), Error);
  EXPECT_THROW(explainer.at(0, -1), Error);
  EXPECT_THROW(explainer.explain(static_cast<DrawableId>(skeleton.drawables.size())), Error);
}

}  // namespace
}  // namespace triptych
