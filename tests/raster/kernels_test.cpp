// Each instruction set writes the bits that the scalar code does, and nothing beyond its rows.
#include "raster/fill.hpp"
#include "raster/instruction_set.hpp"
#include "tests/raster/whole_number.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

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

/// Triangles with their slots; some come twice, and meet themselves at equal depths.
std::vector<WindowTriangle> random_triangles(Random& random, const Size& size, int count) {
  std::vector<WindowTriangle> triangles;
  for (int i = 0; i < count; ++i) {
    WindowTriangle triangle;
    if (!set_up(random_corners(random, i, size), {size.width, size.height}, triangle)) continue;
    triangle.precise.reset();  // what kernels are for
    for (int copies = i % 5 == 0 ? 2 : 1; copies > 0; --copies) {
      triangle.slot = static_cast<uint32_t>(triangles.size());
      triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// What triangles are filled into.
template <typename Word>
struct Buffer {
  Buffer(const Size& size, uint64_t pattern)
      : width(size.width), words(static_cast<size_t>(size.width) * static_cast<size_t>(size.height)) {
    for (size_t i = 0; i < words.size(); ++i) words[i] = static_cast<Word>(pattern * (i % 3));
  }
  PixelBuffer<Word> pixels() { return {words.data(), width}; }
  int width;
  std::vector<Word> words;
};

class RasterKernelsOf : public testing::TestWithParam<InstructionSet> {
 protected:
  static constexpr int rounds = 40, count = 400;

  void SetUp() override {
    const auto& here = instruction_sets_here();
    if (std::count(here.begin(), here.end(), GetParam()) == 0) GTEST_SKIP() << "not of this processor";
    kernels = raster_kernels(GetParam());
  }
  Size random_size() {
    return {kernels->min_width + whole_number(random, 0, 50), whole_number(random, 1, 40)};
  }

  const RasterKernels* kernels = nullptr;
  Random random{11};
};

TEST_P(RasterKernelsOf, write_the_depths_of_the_scalar_code) {
  size_t written = 0;
  for (int round = 0; round < rounds; ++round) {
    const Size size = random_size();
    const int first = whole_number(random, 0, size.height - 1),
              last = whole_number(random, first, size.height - 1);
    Buffer<uint32_t> expected(size, 0x3e000000 / 2), found = expected;
    const std::vector<uint32_t> before = expected.words;
    for (const WindowTriangle& triangle : random_triangles(random, size, count)) {
      if (triangle.top < first || triangle.bottom > last) continue;
      fill(triangle, first, last, expected.pixels(), DepthWriter{});
      kernels->fill_depths(triangle, first, last, found.words.data(), size.width);
      ASSERT_EQ(found.words, expected.words) << size.width << "x" << size.height;
    }
    for (size_t i = 0; i < before.size(); ++i) written += before[i] != expected.words[i];
  }
  EXPECT_GT(written, 1000u);
}

TEST_P(RasterKernelsOf, write_the_words_of_the_scalar_code_and_say_where_depths_are_equal) {
  size_t written = 0, equal = 0;
  for (int round = 0; round < rounds; ++round) {
    const Size size = random_size();
    const int first = whole_number(random, 0, size.height - 1),
              last = whole_number(random, first, size.height - 1);
    const std::vector<WindowTriangle> triangles = random_triangles(random, size, count);
    SlotTable slots(1 << 20);
    DrawnRange range;
    range.triangle_count = static_cast<uint32_t>(triangles.size());
    slots.add(range);
    const VisibilityWriter writer{slots};
    Buffer<VisibilityWord> expected(size, 0), found = expected;
    for (size_t i = 0; i < triangles.size(); ++i) {
      // Later ones lose at equal depth, so that half of them must be drawn the other way round.
      const WindowTriangle& triangle = triangles[round % 2 == 0 ? i : triangles.size() - 1 - i];
      if (triangle.top < first || triangle.bottom > last) continue;
      fill(triangle, first, last, expected.pixels(), writer);
      const Rows rows = kernels->fill_words(triangle, first, last, found.words.data(), size.width);
      equal += rows.first <= rows.last;
      fill(triangle, rows.first, rows.last, found.pixels(), writer);
      ASSERT_EQ(found.words, expected.words) << size.width << "x" << size.height;
    }
    for (const VisibilityWord word : expected.words) written += word != 0;
  }
  EXPECT_GT(written, 1000u);
  EXPECT_GT(equal, 20u);
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
