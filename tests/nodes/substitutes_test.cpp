// What is drawn while chunks are read: it covers all that was to be drawn, and is there.
#include "nodes/substitutes.hpp"

#include "lod/cut.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

/// Has the chunks that it is told to have.
class PartialDevice final : public Device {
 public:
  std::unique_ptr<FrameTarget> make_target(TargetKind, int, int) override { return nullptr; }
  const DeviceNames& names() const override {
    static const DeviceNames names;
    return names;
  }
  void set_geometry_cap(uint64_t) override {}
  void set_missing(const MissingChunks&) override {}
  GeometryUse geometry_use() const override { return {}; }
  bool has_chunk(uint32_t chunk) const override { return chunks.contains(chunk); }
  bool is_damaged(uint32_t chunk) const override { return damaged.contains(chunk); }

  std::set<uint32_t> chunks, damaged;
};

class SubstitutesOf : public testing::TestWithParam<std::string> {
 protected:
  void give(DrawableId id) {
    for (const Placement& placement : hierarchy.placements_of(id)) device.chunks.insert(placement.chunk);
  }
  bool is_there(DrawableId id) const {
    return std::ranges::all_of(hierarchy.placements_of(id),
                               [&](const Placement& placement) { return device.has_chunk(placement.chunk); });
  }
  bool is_below(SceneNodeId node, SceneNodeId ancestor) const {
    for (; node != no_id; node = skeleton.scene_nodes[node].parent) {
      if (node == ancestor) return true;
    }
    return false;
  }

  const Pack& pack = scenes::pack(GetParam());
  const Skeleton& skeleton = pack.skeleton();
  const Hierarchy hierarchy{skeleton};
  PartialDevice device;
  ReadAhead nobody_reads{pack, 0, 1 << 20};
  Substitutes substitutes{hierarchy, device, nobody_reads};
};

TEST_P(SubstitutesOf, cover_every_drawable_once_and_are_there_where_anything_may_be) {
  scenes::Random random(5);
  CutLister lister;
  uint64_t replaced = 0, kept = 0;
  for (const View& view : scenes::random_views(skeleton, 96, 80, 40, 11)) {
    const FrameView frame(skeleton, {view, 0.5});
    VisibleSet wanted = lister.list(frame);
    std::sort(wanted.begin(), wanted.end());
    device.chunks.clear();
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      if (random.index(3) == 0) give(id);
    }
    VisibleSet shown = wanted;
    const size_t missing = substitutes.replace(frame, shown);
    EXPECT_EQ(missing, static_cast<size_t>(std::count_if(wanted.begin(), wanted.end(),
                                                         [&](DrawableId id) { return !is_there(id); })));
    ASSERT_TRUE(std::is_sorted(shown.begin(), shown.end()));
    for (const DrawableId id : wanted) {
      const SceneNodeId node = skeleton.drawables[id].scene_node;
      const auto covering = std::count_if(shown.begin(), shown.end(), [&](DrawableId other) {
        return is_below(node, skeleton.drawables[other].scene_node);
      });
      ASSERT_EQ(covering, 1) << id;
    }
    for (const DrawableId id : shown) {
      const bool was_wanted = std::binary_search(wanted.begin(), wanted.end(), id);
      ASSERT_TRUE(was_wanted || may_stand_for_node(frame, id)) << id;
      replaced += !was_wanted;
      kept += was_wanted;
    }
  }
  EXPECT_GT(kept, 0u);
  EXPECT_EQ(replaced > 0, skeleton.scene_nodes.size() > 1);
}

TEST_P(SubstitutesOf,
       nothing_is_replaced_where_all_is_there_and_the_root_stands_for_all_where_nothing_else_is) {
  CutLister lister;
  const FrameView frame(skeleton, {scenes::random_views(skeleton, 96, 80, 1, 3).front(), 0.5});
  VisibleSet wanted = lister.list(frame);
  std::sort(wanted.begin(), wanted.end());
  for (const DrawableId id : wanted) give(id);
  VisibleSet shown = wanted;
  EXPECT_EQ(substitutes.replace(frame, shown), 0u);
  EXPECT_EQ(shown, wanted);
  EXPECT_EQ(nobody_reads.use().open, 0u);
  device.chunks.clear();
  EXPECT_EQ(substitutes.replace(frame, shown), wanted.size());
  for (const DrawableId id : shown) {
    for (SceneNodeId up = skeleton.scene_nodes[skeleton.drawables[id].scene_node].parent; up != no_id;
         up = skeleton.scene_nodes[up].parent) {
      const SceneNode& node = skeleton.scene_nodes[up];
      for (uint32_t level = 0; level < node.drawable_count; ++level)
        EXPECT_FALSE(may_stand_for_node(frame, node.first_drawable + level)) << "nothing coarser may";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SubstitutesOf, testing::ValuesIn(scenes::names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace triptych
