// The lazy cut agrees with the reference wherever it is asked, in any order.
#include "lod/lazy_cut.hpp"

#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace triptych {
namespace {

class LazyCutOf : public testing::TestWithParam<std::string> {
 protected:
  const Skeleton& skeleton = scenes::pack(GetParam()).skeleton();
  const std::vector<View> views = scenes::path(skeleton, 320, 240);
};

TEST_P(LazyCutOf, a_scene_is_the_reference_s_in_whatever_order_scene_nodes_are_asked_for) {
  std::vector<SceneNodeId> order(skeleton.scene_nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  LazyCut lazy(skeleton);
  CutLister lister;
  scenes::Random random(3);
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const FrameView view(skeleton, {views[frame], scenes::pixel_error(frame)});
    const Cut cut = select_cut(view);
    for (size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
    lazy.begin(view);
    EXPECT_EQ(lazy.selected(), 0u);
    for (const SceneNodeId node : order) ASSERT_EQ(lazy.choice(node), cut.choice[node]) << "frame " << frame;
    EXPECT_EQ(lazy.selected(), cut.drawables.size());
    EXPECT_EQ(lister.list(view), cut.drawables);
  }
}

TEST_P(LazyCutOf, a_scene_selects_only_what_is_asked_for) {
  LazyCut lazy(skeleton);
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const FrameView view(skeleton, {views[frame], scenes::pixel_error(frame)});
    const Cut cut = select_cut(view);
    if (cut.drawables.empty()) continue;
    lazy.begin(view);
    EXPECT_EQ(lazy.choice(skeleton.drawables[cut.drawables.front()].scene_node), cut.drawables.front());
    EXPECT_EQ(lazy.selected(), 1u) << "frame " << frame;
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, LazyCutOf, testing::ValuesIn(scenes::names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace triptych
