// Each instruction set writes the bits that the scalar code does, and nothing beyond its rows; and says no
// more of tiles than is true.
#include "raster/depth_tiles.hpp"
#include "raster/fill.hpp"
#include "raster/instruction_set.hpp"
#include "tests/raster/whole_number.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace triptych {
namespace {

using scenes::Random;

struct Size {
  int width, height;
};

/// Of all sizes and shapes: specks, slivers, and such as go far beyond the picture.
std::array<WindowVertex, 3> random_corners(Random& random, int i, const Size& size) {
  const double reach = std::array{0.0, 20.0, 8000.0}[static_cast<size_t>(i) % 3];
  const auto at = [&](int side) {
    return static_cast<int32_t>(std::floor(random.number(-reach, side + reach) * subpixels));
  };
  std::array<WindowVertex, 3> corners;
  for (WindowVertex& corner : corners) {
    const int32_t x = at(size.width), y = at(size.height);
    corner = {x, y, static_cast<float>(random.number(1e-3, 1))};
  }
  if (i % 2 == 0) {
    const double most = std::exp2(random.number(5, 12));
    for (size_t k = 1; k < 3; ++k) {
      corners[k].x = corners[0].x + static_cast<int32_t>(random.number(-most, most));
      corners[k].y = corners[0].y + static_cast<int32_t>(random.number(-most, most));
    }
  }
  if (i % 7 == 0) {
    corners[2].x = (corners[0].x + corners[1].x) / 2 + static_cast<int32_t>(random.number(-3, 3));
    corners[2].y = (corners[0].y + corners[1].y) / 2 + static_cast<int32_t>(random.number(-3, 3));
  }
  return corners;
}

/// What bounds depths here and there, and elsewhere not.
DepthLimit random_limit(Random& random) {
  DepthLimit limit{.x = {}, .y = {}, .at = {}, .nearest = 1};
  for (int i = 0; i < 3; ++i) {
    limit.x[i] = static_cast<float>(random.number(-0.02, 0.02));
    limit.y[i] = static_cast<float>(random.number(-0.02, 0.02));
    limit.at[i] = static_cast<float>(random.number(0.2, 1.2));
  }
  return limit;
}

/// Sides of a section that keep some of the depths, here and there.
SectionSidesOver random_sides(Random& random) {
  SectionSidesOver sides{};
  for (int i = 0; i < SectionSidesOver::max; ++i) {
    sides.x[i] = static_cast<float>(random.number(-0.02, 0.02));
    sides.y[i] = static_cast<float>(random.number(-0.02, 0.02));
    sides.at[i] = static_cast<float>(random.number(-0.1, 0.5));
    sides.of_depth[i] = static_cast<float>(random.number(-0.5, 0.5));
  }
  return sides;
}

/// Triangles with their slots; some come twice, and meet themselves at equal depths. Every third has to keep
/// the limit, and every fourth is cut by some of the sides.
std::vector<WindowTriangle> random_triangles(Random& random, const Size& size, int count,
                                             const DepthLimit& limit, const SectionSidesOver& sides) {
  std::vector<WindowTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    WindowTriangle triangle;
    if (!set_up(random_corners(random, i, size), {size.width, size.height}, triangle)) continue;
    if (i % 3 == 0) triangle.limit = &limit;
    if (i % 4 == 0) {
      triangle.sides = &sides;
      triangle.cut = 1u << random.index(12) | 1u << random.index(12);
    }
    for (int copies = i % 5 == 0 ? 2 : 1; copies > 0; --copies) {
      triangle.slot = static_cast<uint32_t>(triangles.size());
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// What triangles are filled into. Slots of equal depth: the later one wins, or the earlier.
struct Picture {
  Picture(const Size& of, bool depth_alone, bool later_wins)
      : size(of),
        depths(of.width, of.height),
        slots(depth_alone ? PixelPlane() : PixelPlane(of.width, of.height)),
        tiles(of.width, of.height) {
    target.width = size.width;
    target.height = size.height;
    target.stride = depths.stride();
    target.depths = depths.data();
    target.slots = depth_alone ? nullptr : slots.data();
    tiles.hand_out(target);
    target.order = &ties;
    target.precedes = later_wins ? [](const void* counter, uint32_t slot, uint32_t other) {
      ++*static_cast<size_t*>(const_cast<void*>(counter));
      return slot > other;
    } : [](const void* counter, uint32_t slot, uint32_t other) {
      ++*static_cast<size_t*>(const_cast<void*>(counter));
      return slot < other;
    };
  }
  Picture(const Picture&) = delete;

  /// Depths, and slots of pixels that hold something.
  std::vector<uint32_t> shown() const {
    std::vector<uint32_t> result;
    for (int y = 0; y < size.height; ++y) {
      for (int x = 0; x < size.width; ++x) {
        result.push_back(depths.at(x, y));
        if (depths.at(x, y) != 0 && !slots.empty()) result.push_back(slots.at(x, y));
      }
    }
    return result;
  }
  size_t written() const {
    size_t count = 0;
    for (int y = 0; y < size.height; ++y) {
      for (const uint32_t depth : depths.row(y)) count += depth != 0;
    }
    return count;
  }
  /// Tiles that are not marked and say something else than the farthest depth, or are and say more.
  size_t wrong_tiles() const {
    size_t wrong = 0;
    for (int y = 0; y * 8 < size.height; ++y) {
      for (int x = 0; x * 8 < size.width; ++x) {
        uint32_t least = ~0u;
        for (int j = y * 8; j < std::min(size.height, y * 8 + 8); ++j) {
          for (int i = x * 8; i < std::min(size.width, x * 8 + 8); ++i)
            least = std::min(least, depths.at(i, j));
        }
        const auto farthest = std::bit_cast<float>(least);
        const bool marked = target.marked[y * target.columns + x] != 0;
        wrong += marked ? tiles.farthest(x, y) > farthest : tiles.farthest(x, y) != farthest;
      }
    }
    return wrong;
  }

  Size size;
  size_t ties = 0;  ///< how often slots were compared
  PixelPlane depths, slots;
  DepthTiles tiles;
  FillTarget target{};
};

class RasterKernelsOf : public testing::TestWithParam<InstructionSet> {
 protected:
  static constexpr int rounds = 40, count = 400;

  void SetUp() override {
    const auto& here = instruction_sets_here();
    if (std::count(here.begin(), here.end(), GetParam()) == 0) GTEST_SKIP() << "not of this processor";
    kernels = raster_kernels(GetParam());
  }
  Size random_size() { return {whole_number(random, 1, 60), whole_number(random, 1, 40)}; }

  const RasterKernels* kernels = nullptr;
  Random random{11};
};

TEST_P(RasterKernelsOf, fill_as_the_scalar_code_does_and_keep_tiles_true) {
  size_t written = 0, ties = 0, precise = 0;
  for (int round = 0; round < rounds; ++round) {
    const Size size = random_size();
    const int first = whole_number(random, 0, size.height - 1),
              last = whole_number(random, first, size.height - 1);
    const bool depth_alone = round % 3 == 0, later_wins = round % 2 == 0;
    Picture expected(size, depth_alone, later_wins), found(size, depth_alone, later_wins);
    const DepthLimit limit = random_limit(random);
    const SectionSidesOver sides = random_sides(random);
    for (const WindowTriangle& triangle : random_triangles(random, size, count, limit, sides)) {
      if (triangle.top < first || triangle.bottom > last) continue;
      precise += triangle.precise;
      fill(triangle, first, last, expected.target);
      kernels->fill(triangle, first, last, found.target);
      ASSERT_EQ(found.shown(), expected.shown()) << size.width << "x" << size.height;
      ASSERT_EQ(found.wrong_tiles(), 0u) << size.width << "x" << size.height;
    }
    written += expected.written();
    ties += found.ties;
  }
  EXPECT_GT(written, 1000u);
  EXPECT_GT(ties, 20u);
  EXPECT_GT(precise, 20u);
}

/// Triangles in the window as kernels read them: corners one behind the other, in one of two pieces each.
struct Candidates {
  Candidates(Random& random, const Size& of, int count) : size(of) {
    limits[0] = random_limit(random);
    limits[1] = {.x = {}, .y = {}, .at = {2, 2, 2}, .nearest = 2};
    for (int i = 0; i < count; ++i) {
      const auto corners = random_corners(random, i, size);
      if (pixel_box(corners, {size.width, size.height}).empty()) continue;
      const auto triangle = static_cast<uint32_t>(a.size());
      numbers.push_back(triangle);
      for (size_t k = 0; k < 3; ++k) {
        (k == 0 ? a : k == 1 ? b : c).push_back(static_cast<uint32_t>(x.size()));
        x.push_back(corners[k].x);
        y.push_back(corners[k].y);
        depth.push_back(corners[k].depth);
        pieces.push_back(i % 5 != 0);
      }
    }
    numbers.resize(numbers.size() + 16);
  }
  size_t count() const { return a.size(); }
  std::array<WindowVertex, 3> corners(size_t triangle) const {
    std::array<WindowVertex, 3> result;
    for (size_t k = 0; k < 3; ++k)
      result[k] = {x[3 * triangle + k], y[3 * triangle + k], depth[3 * triangle + k]};
    return result;
  }
  /// As the scalar code makes it.
  bool make(size_t triangle, WindowTriangle& made) const {
    const auto window = corners(triangle);
    if (!set_up(window, {size.width, size.height}, made)) return false;
    made.slot = static_cast<uint32_t>(triangle) + 7;
    const DepthLimit& limit = limits[pieces[3 * triangle]];
    const float least = std::min({slack(limit, window[0]), slack(limit, window[1]), slack(limit, window[2])});
    if (!(least >= made.error)) made.limit = &limit;
    return true;
  }

  Size size;
  std::array<DepthLimit, 2> limits;
  std::vector<int32_t> x, y;
  std::vector<float> depth;
  std::vector<uint8_t> pieces;
  std::vector<uint32_t> a, b, c, numbers;
};

TEST_P(RasterKernelsOf, set_up_and_fill_many_as_the_scalar_code_does_one_by_one) {
  size_t in_blocks = 0, fragments = 0, wide = 0, precise = 0, rest = 0, ties = 0;
  for (int round = 0; round < rounds; ++round) {
    const Size size = random_size();
    Candidates all(random, size, count);
    if (all.count() == 0) continue;
    const int first = whole_number(random, 0, size.height - 1),
              last = whole_number(random, first, size.height - 1);
    const bool depth_alone = round % 3 == 0, later_wins = round % 2 == 0;
    Picture expected(size, depth_alone, later_wins), found(size, depth_alone, later_wins);
    std::vector<NarrowTriangles> blocks(all.count() / 16 + 1);
    std::vector<FillTriangle> others(all.count());
    std::vector<uint32_t> layered(all.count() + 16);
    std::vector<uint32_t> places(4 * all.count() + 16), depths(places.size()), slots(places.size());
    SetUpResult made{};
    made.blocks = blocks.data();
    made.fragments = {places.data(), depths.data(), slots.data()};
    made.wide = others.data();
    made.rest = all.numbers.data();
    made.layered = layered.data();
    const SetUpTerms terms{.points = {all.x.data(), all.y.data(), all.depth.data()},
                           .lattice = {},
                           .transform = nullptr,
                           .layer_offset = {},
                           .corners = {all.a.data(), all.b.data(), all.c.data()},
                           .pieces = all.pieces.data(),
                           .limits = all.limits.data(),
                           .layers = nullptr,
                           .first_slot = 7,
                           .width = size.width,
                           .height = size.height};
    kernels->set_up(terms, all.numbers.data(), static_cast<int32_t>(all.count()), made);
    const auto fill_found = [&](const FillTriangle& triangle) {
      if (triangle.bottom <= last && triangle.top >= first)
        kernels->fill(triangle, first, last, found.target);
    };
    for (int copies = 0; copies < 2; ++copies) {  // each meets itself at equal depths
      for (int32_t i = 0; i < made.block_count; ++i)
        kernels->fill_narrow(blocks[static_cast<size_t>(i)], first, last, found.target);
      kernels->fill_fragments(made.fragments, made.fragment_count, first, last, found.target);
      for (int32_t i = 0; i < made.wide_count; ++i) fill_found(others[static_cast<size_t>(i)]);
      for (int32_t i = 0; i < made.rest_count; ++i) {
        WindowTriangle triangle;
        ASSERT_TRUE(all.make(all.numbers[static_cast<size_t>(i)], triangle));
        ASSERT_NE(triangle.limit, nullptr) << "nothing else is left to the scalar code here";
        fill_found(triangle);
      }
    }
    for (size_t i = 0; i < all.count(); ++i) {
      WindowTriangle triangle;
      if (all.make(i, triangle)) fill(triangle, first, last, expected.target);
    }
    ASSERT_EQ(found.shown(), expected.shown()) << size.width << "x" << size.height;
    ASSERT_EQ(found.wrong_tiles(), 0u) << size.width << "x" << size.height;
    for (int32_t i = 0; i < made.block_count; ++i)
      in_blocks += static_cast<size_t>(std::popcount(blocks[static_cast<size_t>(i)].held));
    for (int32_t i = 0; i < made.wide_count; ++i) precise += others[static_cast<size_t>(i)].precise;
    fragments += static_cast<size_t>(made.fragment_count);
    wide += static_cast<size_t>(made.wide_count);
    rest += static_cast<size_t>(made.rest_count);
    ties += found.ties;
  }
  EXPECT_GT(in_blocks, 200u);
  EXPECT_GT(fragments, 100u);
  EXPECT_GT(wide, 200u);
  EXPECT_GT(precise, 20u);
  EXPECT_GT(rest, 20u);
  EXPECT_GT(ties, 100u);
}

TEST_P(RasterKernelsOf, leave_alone_what_tiles_hide) {
  Picture picture({64, 64}, false, true);
  const auto draw = [&](float depth) {
    const auto corner = [depth](int x, int y) { return WindowVertex{x * subpixels, y * subpixels, depth}; };
    for (const auto& corners : {std::array{corner(0, 0), corner(64, 0), corner(64, 64)},
                                std::array{corner(0, 0), corner(64, 64), corner(0, 64)}}) {
      WindowTriangle triangle;
      ASSERT_TRUE(set_up(corners, {64, 64}, triangle));
      kernels->fill(triangle, 0, 63, picture.target);
    }
  };
  const auto marked = [&] { return std::count(picture.target.marked, picture.target.marked + 64, 1); };
  draw(0.5f);
  EXPECT_EQ(marked(), 64);
  draw(0.25f);
  EXPECT_EQ(marked(), 0) << "tiles were looked at, and nothing was drawn";
  draw(0.5f);
  EXPECT_EQ(marked(), 64) << "what is at the depth of a tile is not hidden by it";
}

std::string name_of(const testing::TestParamInfo<InstructionSet>& set) {
  std::string name = instruction_set_name(set.param);
  std::erase(name, '.');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Sets, RasterKernelsOf,
                         testing::Values(InstructionSet::sse42, InstructionSet::avx2, InstructionSet::avx512),
                         name_of);

}  // namespace
}  // namespace triptych
