// What a set of hidden objects does to scene nodes, against what each placement says of itself.
#include "scene/hidden_objects.hpp"

#include "base/error.hpp"
#include "scene/finest_boxes.hpp"
#include "tests/support/object_sets.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

class HiddenObjectsOf : public testing::TestWithParam<std::string> {
 protected:
  HiddenObjectsOf()
      : pack(scenes::pack_with_objects(GetParam())),
        skeleton(pack.skeleton()),
        objects(pack.read_objects()),
        random(7) {}

  HiddenObjects hidden(const ObjectSet& set) const { return {skeleton, objects, set, "test"}; }

  /// Of a leaf's placements.
  std::vector<SourceObjectId> placement_objects(SceneNodeId leaf) const {
    std::vector<SourceObjectId> each;
    for (const ObjectRun& run : objects.runs_of(leaf)) each.insert(each.end(), run.placements, run.object);
    each.resize(skeleton.drawables[skeleton.scene_nodes[leaf].first_drawable].placement_count, no_id);
    return each;
  }
  /// How many placements of the leaves below are hidden, and how many there are.
  std::pair<size_t, size_t> counted(SceneNodeId node, const ObjectSet& set) const {
    std::pair<size_t, size_t> counts;
    if (skeleton.scene_nodes[node].child_count == 0) {
      for (const SourceObjectId object : placement_objects(node)) {
        counts.first += std::binary_search(set.begin(), set.end(), object);
        ++counts.second;
      }
    }
    for (uint32_t i = 0; i < skeleton.scene_nodes[node].child_count; ++i) {
      const auto below = counted(skeleton.scene_nodes[node].first_child + i, set);
      counts.first += below.first;
      counts.second += below.second;
    }
    return counts;
  }

  const Pack& pack;
  const Skeleton& skeleton;
  const PackObjects objects;
  scenes::Random random;
};

TEST_P(HiddenObjectsOf, each_scene_node_knows_how_much_of_it_is_hidden) {
  size_t some = 0, all = 0;
  for (int round = 0; round < 30; ++round) {
    const ObjectSet set = test::random_set(random, objects.source().objects.size());
    const HiddenObjects applied = hidden(set);
    EXPECT_EQ(applied.objects(), set);
    for (SceneNodeId node = 0; node < skeleton.scene_nodes.size(); ++node) {
      const auto [gone, of] = counted(node, set);
      const HiddenShare right = gone == 0    ? HiddenShare::nothing
                                : gone == of ? HiddenShare::all
                                             : HiddenShare::some;
      ASSERT_EQ(applied.share(node), right) << "scene node " << node << ": " << gone << " of " << of;
      some += right == HiddenShare::some;
      all += right == HiddenShare::all;
      if (skeleton.scene_nodes[node].child_count > 0) continue;
      const auto each = placement_objects(node);
      std::vector<bool> in_runs(each.size());
      for (const PlacementRun& run : applied.hidden_placements(node)) {
        ASSERT_LT(run.first, run.end);
        for (uint32_t i = run.first; i < run.end; ++i) in_runs.at(i) = true;
      }
      for (uint32_t i = 0; i < each.size(); ++i) {
        const bool is_hidden = std::binary_search(set.begin(), set.end(), each[i]);
        EXPECT_EQ(applied.hides(node, i), is_hidden);
        EXPECT_EQ(in_runs[i], is_hidden && right == HiddenShare::some);
      }
    }
  }
  EXPECT_GT(all, 0u);
  EXPECT_EQ(some > 0, skeleton.scene_nodes.size() > 1);
}

TEST_P(HiddenObjectsOf, a_box_touches_what_is_hidden_where_a_leaf_of_it_meets_it) {
  size_t touched = 0, not_touched = 0;
  for (int round = 0; round < 60; ++round) {
    const ObjectSet set = test::random_set(random, objects.source().objects.size());
    const HiddenObjects applied = hidden(set);
    const LatticeBox& all = skeleton.scene_nodes[0].box;
    const auto place = [&](double share) {
      return glm::ivec3(glm::dvec3(all.lo) + random.vector(-0.1, 1.1) * share * glm::dvec3(all.hi - all.lo));
    };
    LatticeBox box;
    box.lo = place(1);
    box.hi = box.lo + glm::max(place(0.2) - all.lo, glm::ivec3(0));
    bool right = false;
    for (const SceneNode& node : skeleton.scene_nodes) {
      if (node.child_count > 0 ||
          counted(static_cast<SceneNodeId>(&node - skeleton.scene_nodes.data()), set).first == 0)
        continue;
      LatticeBox both{glm::max(node.box.lo, box.lo), glm::min(node.box.hi, box.hi)};
      right = right || !both.empty();
    }
    EXPECT_EQ(applied.touches(box), right) << "round " << round;
    (right ? touched : not_touched) += 1;
  }
  EXPECT_GT(touched, 0u);
  EXPECT_GT(not_touched, 0u);
}

TEST_P(HiddenObjectsOf, what_is_shown_has_the_box_of_the_rest) {
  for (int round = 0; round < 10; ++round) {
    const ObjectSet set = test::random_set(random, objects.source().objects.size());
    const HiddenObjects applied = hidden(set);
    const std::vector<Box> whole = finest_boxes(skeleton), shown = finest_boxes(skeleton, &applied);
    for (SceneNodeId node = 0; node < whole.size(); ++node) {
      EXPECT_EQ(shown[node].empty(), applied.share(node) == HiddenShare::all) << node;
      EXPECT_TRUE(applied.share(node) != HiddenShare::nothing || shown[node] == whole[node]) << node;
      EXPECT_TRUE(shown[node].empty() || whole[node].contains(shown[node])) << node;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, HiddenObjectsOf, testing::Values("room", "instances", "storeys", "triangle"),
                         [](const auto& parameter) { return parameter.param; });

TEST(HiddenObjects, a_set_that_is_not_of_the_pack_is_refused) {
  const Pack& pack = scenes::pack_with_objects("room");
  const PackObjects objects = pack.read_objects();
  const auto count = static_cast<SourceObjectId>(objects.source().objects.size());
  const auto error_of = [&](const ObjectSet& set) -> std::string {
    try {
      hide(pack.skeleton(), objects, set, "place");
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(error_of({0, count - 1}), "");
  EXPECT_NE(error_of({count}).find("place: object " + std::to_string(count)), std::string::npos);
  EXPECT_NE(error_of({1, 1}).find("ascending"), std::string::npos);
  EXPECT_NE(error_of({2, 1}).find("ascending"), std::string::npos);
}

TEST(HiddenObjects, sets_have_names_of_their_own_and_the_empty_one_has_none) {
  EXPECT_EQ(hidden_name({}), HiddenName());
  EXPECT_NE(hidden_name(ObjectSet{1, 2}), hidden_name(ObjectSet{1, 3}));
  EXPECT_NE(hidden_name(ObjectSet{1, 2}), hidden_name(ObjectSet{1}));
  EXPECT_EQ(hidden_name(ObjectSet{1, 2}).count, 2u);
}

TEST(HiddenObjects, what_is_in_an_object_goes_with_it) {
  SourceObjects source;
  for (const SourceObjectId parent : {no_id, 0u, 1u, no_id, 3u}) source.objects.push_back({.parent = parent});
  EXPECT_EQ(with_contents(source, ObjectSet{0}), (ObjectSet{0, 1, 2}));
  EXPECT_EQ(with_contents(source, ObjectSet{4, 1, 4}), (ObjectSet{1, 2, 4}));
  EXPECT_EQ(with_contents(source, {}), ObjectSet());
  EXPECT_EQ(all_but(source, {1, 2}), (ObjectSet{0, 3, 4}));
  EXPECT_EQ(all_but(source, {}), (ObjectSet{0, 1, 2, 3, 4}));
  EXPECT_EQ(united({0, 3}, {1, 3}), (ObjectSet{0, 1, 3}));
}

}  // namespace
}  // namespace triptych
