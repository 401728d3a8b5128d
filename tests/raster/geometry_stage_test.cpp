// From a chunk to triangles that can be filled: each instruction set makes the same ones as the scalar code,
// and leaves out only what tiles hide.
#include "raster/geometry_stage.hpp"

#include "raster/depth_tiles.hpp"
#include "raster/fill.hpp"
#include "raster/instruction_set.hpp"
#include "tests/raster/opaque_palette.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <bit>
#include <compare>
#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

using scenes::Random;

constexpr int width = 200, height = 150;

/// Triangles of all sizes around the eye, some of them through the near plane, in two pieces and three
/// layers.
Chunk random_chunk(uint32_t seed) {
  Random random(seed);
  Chunk chunk;
  for (uint32_t i = 0; i < 500; ++i) {
    const glm::dvec3 at(random.number(-3, 3), random.number(-3, 3), random.number(-9, 1));
    const double size = std::exp2(random.number(-7, 1));
    for (int corner = 0; corner < 3; ++corner) {
      chunk.indices.push_back(static_cast<uint32_t>(chunk.vertices.size()));
      const glm::ivec3 point((at + size * random.vector(-1, 1)) * 1024.0);
      const uint32_t layer = i % 5 < 3 ? 0 : i % 3;
      chunk.vertices.push_back({.point = point, .color = 0, .layer = layer & 15, .piece = i % 2});
    }
    if (i % 3 == 0 || i % 70 == 0) chunk.outward_runs.push_back(i);
  }
  return chunk;
}

/// A pixel that a triangle covers. Triangles are compared by theirs: what is set up differs in form.
struct Pixel {
  uint32_t slot;
  int32_t y, x;
  uint32_t depth;  ///< bits
  auto operator<=>(const Pixel&) const = default;
};

FillTriangle lane_of(const NarrowTriangles& all, size_t i) {
  FillTriangle triangle{};
  for (size_t k = 0; k < 3; ++k) {
    triangle.edge[k] = all.edge[k][i];
    triangle.step_x[k] = all.step_x[k][i];
    triangle.step_y[k] = all.step_y[k][i];
  }
  triangle.left = all.left[i];
  triangle.right = all.right[i];
  triangle.bottom = all.bottom[i];
  triangle.top = all.top[i];
  triangle.first_x = all.first_x[i];
  triangle.first_y = all.first_y[i];
  triangle.z = all.z[i];
  triangle.slope_x = all.slope_x[i];
  triangle.slope_y = all.slope_y[i];
  triangle.low = all.low[i];
  triangle.high = all.high[i];
  triangle.slot = all.slot[i];
  return triangle;
}

/// What a stretch became, pixel by pixel, in order.
struct Made {
  std::vector<Pixel> pixels;
  size_t narrow = 0, fragments = 0, wide = 0, precise = 0;  ///< in which form

  explicit Made(const StretchTriangles& from) {
    for (const auto* const list : {&from.small, &from.large}) {
      for (const WindowTriangle& triangle : *list) add(triangle, from);
    }
    for (const FillTriangle& triangle : from.kernel.wide()) {
      add(triangle, from);
      ++wide;
    }
    for (const NarrowTriangles& all : from.kernel.narrow()) {
      EXPECT_NE(all.held, 0u);
      for (size_t i = 0; i < NarrowTriangles::count; ++i) {
        if ((all.held >> i & 1) == 0) continue;
        EXPECT_LE(all.lowest_row, all.bottom[i]);
        EXPECT_GE(all.highest_row, all.top[i]);
        add(lane_of(all, i), from);
        ++narrow;
      }
    }
    const Fragments single = from.kernel.fragments();
    for (int32_t i = 0; i < from.kernel.fragment_count(); ++i, ++fragments) {
      pixels.push_back({single.slots[i], static_cast<int32_t>(single.places[i] >> 16),
                        static_cast<int32_t>(single.places[i] & 0xffff), single.depths[i]});
    }
    for (const Pixel& pixel : pixels) {
      EXPECT_GE(pixel.y, from.bottom);
      EXPECT_LE(pixel.y, from.top);
    }
    std::sort(pixels.begin(), pixels.end());
  }

  std::set<uint32_t> slots() const {
    std::set<uint32_t> found;
    for (const Pixel& pixel : pixels) found.insert(pixel.slot);
    return found;
  }

 private:
  void add(const FillTriangle& triangle, const StretchTriangles& from) {
    precise += triangle.precise;
    EXPECT_LE(from.bottom, triangle.bottom);
    EXPECT_GE(from.top, triangle.top);
    for_each_pixel(triangle, 0, height - 1, [&](int32_t x, int32_t y, float depth) {
      if (depth > 0) pixels.push_back({triangle.slot, y, x, std::bit_cast<uint32_t>(depth)});
    });
  }
};

class Stage {
 public:
  Stage(bool orthographic, uint32_t seed)
      : chunk_(random_chunk(seed), test::opaque_palette), tiles_(width, height) {
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

  Made make(InstructionSet set, uint32_t first, uint32_t count, int32_t front = 0) {
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
    return Made(result);
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

TEST(GeometryStage, makes_the_same_triangles_with_every_instruction_set) {
  size_t made = 0, precise = 0, narrow = 0, fragments = 0, wide = 0;
  for (uint32_t seed = 1; seed <= 20; ++seed) {
    Stage stage(seed % 4 == 0, seed);
    const int32_t front = static_cast<int32_t>(seed % 3) - 1;
    for (const auto& [first, count] : {std::pair(0u, 500u), {3u, 1u}, {63u, 130u}, {499u, 1u}, {77u, 0u}}) {
      const Made expected = stage.make(InstructionSet::scalar, first, count, front);
      made += expected.slots().size();
      precise += expected.precise;
      for (const InstructionSet set : instruction_sets_here()) {
        const Made found = stage.make(set, first, count, front);
        ASSERT_EQ(found.pixels, expected.pixels)
            << instruction_set_name(set) << " " << seed << " " << first << "+" << count;
        narrow += found.narrow;
        fragments += found.fragments;
        wide += found.wide;
      }
    }
  }
  EXPECT_GT(made, 2000u);
  EXPECT_GT(precise, 500u) << "as layered ones are";
  EXPECT_GT(narrow, 1000u);
  EXPECT_GT(fragments, 500u);
  EXPECT_GT(wide, 1000u);
}

TEST(GeometryStage, leaves_out_backs_of_what_is_outward_and_is_not_clipped) {
  size_t one_side = 0, both = 0;
  for (uint32_t seed = 1; seed <= 10; ++seed) {
    Stage stage(false, seed);
    const auto slots = [&](int32_t front) {
      return stage.make(InstructionSet::scalar, 0, 500, front).slots();
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
    const std::vector<Pixel> all = stage.make(InstructionSet::scalar, 0, 500).pixels;
    constexpr float there = 0.025f;
    stage.hide_beyond(there);
    for (const InstructionSet set : instruction_sets_here()) {
      const std::vector<Pixel> kept = stage.make(set, 0, 500).pixels;
      auto next = kept.begin();
      for (const Pixel& pixel : all) {
        if (next != kept.end() && *next == pixel) {
          ++next;
        } else {
          ASSERT_LT(std::bit_cast<float>(pixel.depth), there) << instruction_set_name(set);
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
