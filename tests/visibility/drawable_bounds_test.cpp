#include "visibility/drawable_bounds.hpp"

#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

class DrawableBoundsOf : public testing::TestWithParam<std::string> {
 protected:
  const Pack& pack = scenes::pack(GetParam());
  const Skeleton& skeleton = pack.skeleton();
  const Hierarchy hierarchy{skeleton};
};

TEST_P(DrawableBoundsOf, a_piece_are_boxes_that_hold_its_vertices_within_its_placements_within_its_nodes) {
  size_t several = 0;
  for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
    const Drawable& drawable = skeleton.drawables[id];
    const LatticeBox& node_box = skeleton.scene_nodes[drawable.scene_node].box;
    const PlacedDrawable placed = hierarchy.placed(id);
    ASSERT_EQ(placed.placements.size(), drawable.placement_count);
    EXPECT_EQ(hierarchy.placed(id).placements.data(), placed.placements.data()) << "computed twice";
    size_t first_piece = 0;
    for (uint32_t i = 0; i < drawable.placement_count; ++i) {
      const Placement& placement = skeleton.placements[drawable.first_placement + i];
      const LatticeBox whole = placed.placements[i];
      ASSERT_EQ(whole, placed_box(skeleton, placement, skeleton.chunks[placement.chunk].box, node_box));
      ASSERT_TRUE(node_box.contains(whole));
      const auto boxes = placed.pieces.subspan(first_piece, skeleton.pieces_of(placement.chunk).size());
      first_piece += boxes.size();
      several += boxes.size() > 1;
      const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
      for (const ChunkVertex& vertex : pack.read_chunk(placement.chunk).vertices) {
        const glm::dvec3 position =
            skeleton.transforms[placement.transform] * glm::dvec4(lattice.position(vertex.point), 1);
        ASSERT_TRUE(whole.contains(boxes[vertex.piece]));
        ASSERT_TRUE(skeleton.lattice().box(boxes[vertex.piece]).contains(Box{position, position}));
      }
    }
    ASSERT_EQ(placed.pieces.size(), first_piece);
  }
  EXPECT_TRUE(several > 0 || GetParam() != "instances");
}

TEST_P(DrawableBoundsOf, a_drawable_are_no_wider_than_its_nodes) {
  size_t closer = 0;
  for (const View& view : scenes::path(skeleton, 320, 240)) {
    const BoxProjector projector(FrameView(skeleton, {view}));
    for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
      const ScreenBounds node = projector.bounds(skeleton.scene_nodes[skeleton.drawables[id].scene_node].box);
      const DrawableBounds found = drawable_bounds(hierarchy, projector, id);
      if (node.kind == ScreenBounds::Kind::off_screen) {
        ASSERT_EQ(found.kind, node.kind);
      }
      closer += found.kind != node.kind;
      if (found.kind != ScreenBounds::Kind::rectangle || node.kind != found.kind) continue;
      ASSERT_FALSE(found.rectangles.empty());
      for (const ScreenRectangle& piece : found.rectangles) {
        ASSERT_GE(piece.left, node.rectangle.left);
        ASSERT_LE(piece.right, node.rectangle.right);
        ASSERT_GE(piece.bottom, node.rectangle.bottom);
        ASSERT_LE(piece.top, node.rectangle.top);
      }
    }
  }
  if (GetParam() == "instances") {
    EXPECT_GT(closer, 0u);
  }
}

/// The drawable's first placement so many times.
Skeleton repeated(const Skeleton& original, DrawableId id, uint32_t times) {
  Skeleton skeleton = original;
  Drawable& drawable = skeleton.drawables[id];
  const Placement placement = skeleton.placements[drawable.first_placement];
  drawable.first_placement = static_cast<uint32_t>(skeleton.placements.size());
  drawable.placement_count = times;
  skeleton.placements.insert(skeleton.placements.end(), times, placement);
  return skeleton;
}

TEST_P(DrawableBoundsOf, a_drawable_of_many_placements_or_pieces_are_of_fewer_boxes) {
  size_t tried = 0;
  for (const View& view : scenes::path(skeleton, 320, 240)) {
    const BoxProjector projector(FrameView(skeleton, {view}));
    for (DrawableId id = 0; id < skeleton.drawables.size() && tried < 5; ++id) {
      const Drawable& drawable = skeleton.drawables[id];
      const LatticeBox& box = skeleton.scene_nodes[drawable.scene_node].box;
      if (projector.bounds(box).kind != ScreenBounds::Kind::rectangle) continue;
      const auto boxes = [&](uint32_t times) {
        const Skeleton many = repeated(skeleton, id, times);
        return placement_bounds(Hierarchy(many), BoxProjector(FrameView(many, {view})), id).rectangles.size();
      };
      if (boxes(1) == 0) continue;
      ++tried;
      EXPECT_EQ(boxes(32), 32u);
      EXPECT_EQ(boxes(33), 1u);
      const auto pieces = static_cast<uint32_t>(
          skeleton.pieces_of(skeleton.placements[drawable.first_placement].chunk).size());
      const Skeleton few = repeated(skeleton, id, 256 / pieces),
                     many = repeated(skeleton, id, 256 / pieces + 1);
      EXPECT_EQ(has_pieces(Hierarchy(few), id), pieces > 1);
      EXPECT_FALSE(has_pieces(Hierarchy(many), id));
    }
  }
  EXPECT_GT(tried, 0u);
}

INSTANTIATE_TEST_SUITE_P(Scenes, DrawableBoundsOf, testing::ValuesIn(scenes::names()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace triptych
