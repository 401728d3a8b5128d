// Cuts of models of which something is hidden.
#include "base/error.hpp"
#include "lod/lazy_cut.hpp"
#include "lod/representation.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

class HiddenCut : public testing::TestWithParam<std::string> {
 protected:
  HiddenCut()
      : pack(scenes::pack_with_objects(GetParam())),
        skeleton(pack.skeleton()),
        objects(pack.read_objects()),
        views(scenes::random_views(skeleton, 96, 72, 40, 4)) {}

  /// The frame, and a set to hide in it, from its number alone.
  FrameState state(size_t frame) const {
    scenes::Random random(static_cast<uint32_t>(frame));
    FrameState state{views[frame], scenes::pixel_error(frame)};
    state.hiding = hide(skeleton, objects, test::random_set(random, objects.source().objects.size()), "test");
    return state;
  }

  const Pack& pack;
  const Skeleton& skeleton;
  const PackObjects objects;
  const std::vector<View> views;
};

TEST_P(HiddenCut, draws_each_placement_that_is_not_hidden_and_no_other) {
  const Hierarchy hierarchy(skeleton);
  LevelsRepresentation representation(hierarchy);
  size_t refined = 0;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    SCOPED_TRACE(testing::Message() << "frame " << frame);
    const FrameState now = state(frame);
    for (const FrustumCulling culling : {FrustumCulling::on, FrustumCulling::off}) {
      // Levels that leave out what hidden things cover are another matter (tests/lod/cut_test.cpp).
      const FrameRules rules{.levels_from_outside = false};
      const FrameView view(skeleton, now, rules);
      FrameState without = now;
      without.hiding = {};
      const Cut cut = select_cut(view, culling),
                whole = select_cut(FrameView(skeleton, without, rules), culling);
      // Where the whole model's cut has a drawable, this one has it too, or what is below it and not hidden.
      for (const DrawableId id : whole.drawables) {
        const SceneNodeId node = skeleton.drawables[id].scene_node;
        const bool inner = skeleton.scene_nodes[node].child_count > 0;
        const DrawableId chosen = cut.choice[node];
        switch (view.hidden(node)) {
          case HiddenShare::nothing:
            EXPECT_EQ(chosen, id);
            break;
          case HiddenShare::some:
            EXPECT_EQ(chosen, inner ? Cut::inner : id);
            refined += inner;
            break;
          case HiddenShare::all:
            EXPECT_EQ(chosen, no_id);
            break;
        }
      }
      representation.begin(view);
      for (const DrawableId id : cut.drawables) {
        const SceneNodeId node = skeleton.drawables[id].scene_node;
        ASSERT_NE(view.hidden(node), HiddenShare::all);
        std::vector<DrawItem> items;
        representation.append(id, items);
        std::vector<std::pair<uint32_t, uint32_t>> drawn, right;
        for (const DrawItem& item : items) drawn.emplace_back(item.chunk, item.transform);
        uint32_t number = 0;
        for (const Placement& placement : hierarchy.placements_of(id)) {
          const bool gone = now.hiding.objects && now.hiding.objects->hides(node, number);
          ++number;
          if (!gone && skeleton.chunks[placement.chunk].triangle_count > 0)
            right.emplace_back(placement.chunk, placement.transform);
        }
        EXPECT_EQ(drawn, right);
        EXPECT_FALSE(drawn.empty());
      }
    }
  }
  EXPECT_EQ(refined > 0, skeleton.scene_nodes.size() > 1);
}

TEST_P(HiddenCut, selected_lazily_is_the_same) {
  LazyCut lazy(skeleton);
  CutLister lister;
  for (size_t frame = 0; frame < views.size(); ++frame) {
    const FrameView view(skeleton, state(frame));
    const Cut cut = select_cut(view);
    lazy.begin(view);
    for (SceneNodeId node = 0; node < skeleton.scene_nodes.size(); ++node)
      ASSERT_EQ(lazy.choice(node), cut.choice[node]) << "frame " << frame << ", scene node " << node;
    EXPECT_EQ(lister.list(view), cut.drawables);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, HiddenCut, testing::Values("room", "instances", "storeys", "triangle"),
                         [](const auto& parameter) { return parameter.param; });

TEST(HiddenCuts, a_frame_whose_hidden_set_did_not_come_is_refused) {
  const Pack& pack = scenes::pack_with_objects("room");
  FrameState state{scenes::random_views(pack.skeleton(), 96, 72, 1, 4)[0]};
  state.hiding.name = {3, 17};
  EXPECT_THROW(FrameView(pack.skeleton(), state), Error);
}

}  // namespace
}  // namespace triptych
