// A visible set in terms of another cut: kept, an ancestor, descendants, or nothing.
#include "visibility/map_to_cut.hpp"

#include "tests/support/scenes.hpp"
#include "tests/support/small_pack.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Root (drawable 0) over two leaves (drawables 1, 2 and 3, 4).
class MapToCut : public testing::Test {
 protected:
  const Skeleton skeleton = test::small_pack().skeleton;
  std::vector<DrawableId> map(const std::vector<DrawableId>& choice, const VisibleSet& visible) const {
    Cut cut;
    cut.choice = choice;
    LazyCut lazy(skeleton);
    lazy.begin(FrameView(skeleton, {}), cut);
    return CutMapper(skeleton).map(lazy, visible);
  }
};

TEST_F(MapToCut, what_is_in_both_cuts_is_kept) {
  EXPECT_EQ(map({Cut::inner, 1, 3}, {1}), (std::vector<DrawableId>{1}));
  EXPECT_EQ(map({Cut::inner, 1, 3}, {1, 3}), (std::vector<DrawableId>{1, 3}));
}

TEST_F(MapToCut, another_level_of_detail_of_the_same_scene_node_is_taken) {
  EXPECT_EQ(map({Cut::inner, 2, 3}, {1}), (std::vector<DrawableId>{2}));
}

TEST_F(MapToCut, an_ancestor_in_the_cut_stands_for_what_is_below_it_once) {
  EXPECT_EQ(map({0, no_id, no_id}, {1, 4}), (std::vector<DrawableId>{0}));
}

TEST_F(MapToCut, the_descendants_in_the_cut_stand_for_what_was_above_them) {
  EXPECT_EQ(map({Cut::inner, 2, 3}, {0}), (std::vector<DrawableId>{2, 3}));
  EXPECT_EQ(map({Cut::inner, 2, no_id}, {0}), (std::vector<DrawableId>{2}));
}

TEST_F(MapToCut, what_left_the_frustum_maps_to_nothing) {
  EXPECT_TRUE(map({Cut::inner, 2, no_id}, {3}).empty());
  EXPECT_TRUE(map({no_id, no_id, no_id}, {0, 1, 2, 3, 4}).empty());
}

class MapToCutOf : public testing::TestWithParam<std::string> {};

TEST_P(MapToCutOf, gives_drawables_of_the_cut_alone_each_once_in_draw_rank_order) {
  const Skeleton& skeleton = scenes::pack(GetParam()).skeleton();
  const std::vector<View> views = scenes::path(skeleton, 320, 240);
  Cut last = select_cut(FrameView(skeleton, {views[0], 1}));
  LazyCut lazy(skeleton);
  CutMapper mapper(skeleton);
  for (size_t frame = 1; frame < views.size(); ++frame) {
    const FrameView view(skeleton, {views[frame], scenes::pixel_error(frame)});
    const Cut cut = select_cut(view);
    lazy.begin(view);
    VisibleSet visible = last.drawables;
    std::sort(visible.begin(), visible.end());
    const std::vector<DrawableId> mapped = mapper.map(lazy, visible);
    for (size_t i = 0; i < mapped.size(); ++i) {
      EXPECT_EQ(cut.choice[skeleton.drawables[mapped[i]].scene_node], mapped[i]) << "is not in the cut";
      if (i > 0) {
        EXPECT_LT(draw_rank(skeleton, view.cell, mapped[i - 1]), draw_rank(skeleton, view.cell, mapped[i]));
      }
    }
    VisibleSet whole = cut.drawables;
    std::sort(whole.begin(), whole.end());
    EXPECT_EQ(mapper.map(lazy, whole), cut.drawables) << "a cut mapped to itself is itself";
    last = cut;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MapToCutOf, testing::ValuesIn(scenes::names()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
