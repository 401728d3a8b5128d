// From a chunk to triangles that can be filled: each instruction set makes the same ones as the scalar code,
// and leaves out only what tiles hide.
#include "raster/geometry_stage.hpp"

#include "raster/depth_tiles.hpp"
#include "raster/instruction_set.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

using scenes::Random;

constexpr int width = 200, height = 150;

/// Triangles of all sizes around the eye, some of them through the near plane, in two pieces.
Chunk random_chunk(uint32_t seed) {
  Random random(seed);
  Chunk chunk;
  for (uint32_t i = 0; i < 500; ++i) {
    const glm::dvec3 at(random.number(-3, 3), random.number(-3, 3), random.number(-9, 1));
    const double size = std::exp2(random.number(-7, 1));
    for (int corner = 0; corner < 3; ++corner) {
      chunk.indices.push_back(static_cast<uint32_t>(chunk.vertices.size()));
      const glm::ivec3 point((at + size * random.vector(-1, 1)) * 1024.0);
      chunk.vertices.push_back({.point = point, .color = 0, .piece = i % 2});
    }
    if (i % 3 == 0 || i % 70 == 0) chunk.outward_runs.push_back(i);
  }
  return chunk;
}

class Stage {
 public:
  Stage(bool orthographic, uint32_t seed) : chunk_(random_chunk(seed)), tiles_(width, height) {
    skeleton_.lattices.push_back({glm::dvec3(0), 1.0 / 1024});
    skeleton_.transforms.push_back(Affine(1.0));
    skeleton_.scene_nodes.push_back({.box = {glm::ivec3(-100000), glm::ivec3(100000)}});
    View view{.camera = {}, .width = width, .height = height};
    if (orthographic) {
      view.camera.projection = Projection::orthographic;
      view.camera.left = view.camera.bottom = -3;
      view.camera.right = view.camera.top = 3;
    } else {
      set_field_of_view(view.camera, 70, static_cast<double>(width) / height);
    }
    frame_.emplace(skeleton_, FrameState{view});
    projector_.emplace(*frame_, raster_margins);
    terms_.emplace(*frame_, *projector_);
    placer_.emplace(skeleton_);
    placer_->begin(*frame_);
    source_.width = width;
    source_.height = height;
    tiles_.hand_out(source_);
  }

  std::vector<WindowTriangle> make(InstructionSet set, uint32_t first, uint32_t count, int32_t front = 0) {
    const DrawnRange range{.rank = {},
                           .first_triangle = first,
                           .triangle_count = count,
                           .first_slot = 1000,
                           .front = front,
                           .chunk = &chunk_,
                           .placed = placer_->place(0, 0)};
    const std::array<LatticeBox, 2> pieces = {skeleton_.scene_nodes[0].box, skeleton_.scene_nodes[0].box};
    StretchTriangles result;
    force_instruction_set(set);
    make_triangles(*terms_, range, pieces, source_, result);
    force_instruction_set(std::nullopt);
    std::vector<WindowTriangle> triangles = result.small;
    triangles.insert(triangles.end(), result.large.begin(), result.large.end());
    for (WindowTriangle& triangle : triangles) triangle.limit = nullptr;  // points into what is gone
    std::stable_sort(triangles.begin(), triangles.end(),
                     [](const WindowTriangle& a, const WindowTriangle& b) { return a.slot < b.slot; });
    return triangles;
  }

  bool is_outward(uint32_t triangle) const { return chunk_.is_outward(triangle); }

  /// As if something stood so far away in every tile.
  void hide_beyond(float depth) {
    FillTarget target{};
    tiles_.hand_out(target);
    std::fill(target.tiles, target.tiles + target.columns * ((height + 7) / 8), depth);
  }

 private:
  Skeleton skeleton_;
  RasterChunk chunk_;
  DepthTiles tiles_;
  std::optional<FrameView> frame_;
  std::optional<BoxProjector> projector_;
  std::optional<GeometryTerms> terms_;
  std::optional<LatticePlacer> placer_;
  DepthSource source_{};
};

bool same(const WindowTriangle& a, const WindowTriangle& b) {
  return std::equal(a.edge, a.edge + 3, b.edge) && std::equal(a.step_x, a.step_x + 3, b.step_x) &&
         std::equal(a.step_y, a.step_y + 3, b.step_y) && a.left == b.left && a.right == b.right &&
         a.bottom == b.bottom && a.top == b.top && a.first_x == b.first_x && a.first_y == b.first_y &&
         a.z == b.z && a.slope_x == b.slope_x && a.slope_y == b.slope_y && a.low == b.low &&
         a.high == b.high && a.slot == b.slot && a.precise == b.precise && a.error == b.error;
}

TEST(GeometryStage, makes_the_same_triangles_with_every_instruction_set) {
  size_t made = 0, precise = 0;
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    Stage stage(seed % 4 == 0, seed);
    const int32_t front = static_cast<int32_t>(seed % 3) - 1;
    for (const auto& [first, count] : {std::pair(0u, 500u), {3u, 1u}, {63u, 130u}, {499u, 1u}, {77u, 0u}}) {
      const std::vector<WindowTriangle> expected = stage.make(InstructionSet::scalar, first, count, front);
      made += expected.size();
      for (const WindowTriangle& triangle : expected) precise += triangle.precise;
      for (const InstructionSet set : instruction_sets_here()) {
        const std::vector<WindowTriangle> found = stage.make(set, first, count, front);
        ASSERT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end(), same))
            << instruction_set_name(set) << " " << seed << " " << first << "+" << count;
      }
    }
  }
  EXPECT_GT(made, 2000u);
  EXPECT_GT(precise, 20u);
}

TEST(GeometryStage, leaves_out_backs_of_what_is_outward_and_is_not_clipped) {
  size_t one_side = 0, both = 0;
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    Stage stage(false, seed);
    const auto slots = [&](int32_t front) {
      std::set<uint32_t> found;
      for (const WindowTriangle& triangle : stage.make(InstructionSet::scalar, 0, 500, front))
        found.insert(triangle.slot);
      return found;
    };
    const std::set<uint32_t> ahead = slots(1), mirrored = slots(-1);
    for (const uint32_t slot : slots(0)) {
      const bool outward = stage.is_outward(slot - 1000);
      EXPECT_TRUE(ahead.contains(slot) || mirrored.contains(slot));
      EXPECT_TRUE(outward || (ahead.contains(slot) && mirrored.contains(slot)));
      if (outward) ++(ahead.contains(slot) != mirrored.contains(slot) ? one_side : both);
    }
  }
  EXPECT_GT(one_side, 200u);
  EXPECT_GT(both, 2u) << "of those that are clipped";
}

TEST(GeometryStage, leaves_out_only_what_lies_behind_tiles) {
  size_t left_out = 0;
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    Stage stage(false, seed);
    const std::vector<WindowTriangle> all = stage.make(InstructionSet::scalar, 0, 500);
    constexpr float there = 0.025f;
    stage.hide_beyond(there);
    for (const InstructionSet set : instruction_sets_here()) {
      const std::vector<WindowTriangle> kept = stage.make(set, 0, 500);
      auto next = kept.begin();
      for (const WindowTriangle& triangle : all) {
        if (next != kept.end() && same(*next, triangle)) {
          ++next;
        } else {
          ASSERT_LT(triangle.high, there) << instruction_set_name(set);
          ++left_out;
        }
      }
      ASSERT_EQ(next, kept.end()) << "others than without tiles";
    }
  }
  EXPECT_GT(left_out, 100u);
}

}  // namespace
}  // namespace triptych
