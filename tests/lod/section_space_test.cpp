// Where boxes lie in a section, and what of the cut is left.
#include "lod/lazy_cut.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace triptych {
namespace {

Section random_section(const Box& box, scenes::Random& random) {
  const auto inside = [&] { return box.lo + (box.hi - box.lo) * random.vector(0, 1); };
  Section section;
  for (uint32_t planes = random.index(4); planes > 0; --planes) {
    const glm::dvec3 normal = glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
    section.add_plane({normal, glm::dot(normal, inside())}, "test");
  }
  if (section.keeps_all() || random.index(3) == 0) {
    const glm::dvec3 a = inside(), b = inside();
    section.set_box({glm::min(a, b), glm::max(a, b)}, "test");
  }
  return section;
}

bool keeps(const Section& section, const glm::dvec3& point) {
  const SectionSides sides(section);
  return std::ranges::all_of(sides.all(), [&](const auto& side) { return side.distance(point) >= 0; });
}

TEST(SectionSpace, without_a_section_everything_is_inside) {
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  const FrameView view(skeleton, {scenes::random_views(skeleton, 64, 48, 1, 1).front(), 1});
  for (const SceneNode& node : skeleton.scene_nodes) {
    EXPECT_TRUE(view.section_place(node.box).inside());
    EXPECT_FALSE(view.section_place(node.box).outside);
  }
}

TEST(SectionSpace, says_outside_and_inside_only_of_boxes_that_are) {
  size_t outside = 0, inside = 0, cut = 0;
  for (const std::string name : {"room", "far", "storeys", "dust"}) {
    const Skeleton& skeleton = scenes::pack(name).skeleton();
    const Box model = skeleton.lattice().box(skeleton.scene_nodes.front().box);
    scenes::Random random(2);
    for (const View& view : scenes::random_views(skeleton, 64, 48, 60, 4)) {
      FrameState state{view, 1};
      state.section = random_section(model, random);
      const FrameView frame(skeleton, state);
      for (const SceneNode& node : skeleton.scene_nodes) {
        const SectionPlace place = frame.section_place(node.box);
        const Box box = skeleton.lattice().box(node.box);
        for (int i = 0; i < 16; ++i) {
          const glm::dvec3 point = i < 8 ? box.corner(i) : box.lo + (box.hi - box.lo) * random.vector(0, 1);
          const bool kept = keeps(state.section, point);
          ASSERT_FALSE(place.outside && kept) << name;
          ASSERT_FALSE(place.inside() && !kept) << name;
        }
        ASSERT_FALSE(place.outside && place.inside());
        (place.outside ? outside : place.inside() ? inside : cut) += 1;
      }
    }
  }
  EXPECT_GT(outside, 1000u);
  EXPECT_GT(inside, 1000u);
  EXPECT_GT(cut, 1000u);
}

TEST(SectionSpace, a_face_that_lies_in_a_side_is_not_outside) {
  const Skeleton& skeleton = scenes::pack("room").skeleton();
  const Box model = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  FrameState state{scenes::random_views(skeleton, 64, 48, 1, 1).front(), 1};
  for (const double sign : {-1.0, 1.0}) {
    state.section = {};
    state.section.add_plane({{sign, 0, 0}, sign * (sign > 0 ? model.hi.x : model.lo.x)}, "test");
    const FrameView view(skeleton, state);
    EXPECT_FALSE(view.section_place(skeleton.scene_nodes.front().box).outside);
    EXPECT_FALSE(view.section_place(skeleton.scene_nodes.front().box).inside());
  }
}

TEST(SectionSpace, of_the_cut_that_is_left_what_is_not_outside) {
  const Skeleton& skeleton = scenes::pack("storeys").skeleton();
  const Box model = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  scenes::Random random(8);
  LazyCut lazy(skeleton);
  size_t fewer = 0;
  for (const View& view : scenes::random_views(skeleton, 64, 48, 40, 6)) {
    FrameState state{view, 0};
    const std::vector<DrawableId> whole = select_cut(FrameView(skeleton, state)).drawables;
    state.section = random_section(model, random);
    const FrameView frame(skeleton, state);
    const Cut cut = select_cut(frame);
    std::vector<DrawableId> left;
    for (const DrawableId id : whole) {
      // What belongs to a solid that reaches further counts with it.
      const SceneNodeId node = skeleton.drawables[id].scene_node;
      if (!frame.section_place(skeleton.closed.reach(node, skeleton.scene_nodes[node])).outside)
        left.push_back(id);
    }
    EXPECT_EQ(cut.drawables, left);
    fewer += left.size() < whole.size();
    lazy.begin(frame);
    for (SceneNodeId node = 0; node < skeleton.scene_nodes.size(); ++node)
      ASSERT_EQ(lazy.choice(node), cut.choice[node]);
  }
  EXPECT_GT(fewer, 5u);
}

TEST(SectionSpace, what_is_cut_has_full_detail_and_what_is_not_has_as_much_as_without) {
  const Skeleton& skeleton = scenes::pack("storeys").skeleton();
  const Box model = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  scenes::Random random(9);
  size_t coarse = 0, fine = 0;
  for (const View& view : scenes::random_views(skeleton, 64, 48, 40, 6)) {
    FrameState state{view, 16};
    const Cut without = select_cut(FrameView(skeleton, state));
    state.section = random_section(model, random);
    const FrameView frame(skeleton, state);
    for (const DrawableId id : select_cut(frame).drawables) {
      const SceneNodeId node = skeleton.drawables[id].scene_node;
      const SceneNode& of = skeleton.scene_nodes[node];
      if (frame.section_place(of.box).inside()) {
        ++coarse;
        EXPECT_TRUE(without.choice[node] == no_id || without.choice[node] == id);
      } else {
        ++fine;
        EXPECT_EQ(of.child_count, 0u);
        EXPECT_EQ(id, of.first_drawable);
      }
    }
  }
  EXPECT_GT(coarse, 20u);
  EXPECT_GT(fine, 20u);
}

}  // namespace
}  // namespace triptych
