// What levels an inner scene node gets.
#include "preprocess/hlod_unit.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

struct Made {
  size_t chunks = 0;
  HlodFigures figures;
  Baked coarsest;
};

/// A node over two leaves, each a bumpy square; all points are in contact with leaves up to `last`.
Made make(uint32_t last, uint32_t hlod_triangles = 32) {
  BuildOptions options;
  options.hlod_triangles = hlod_triangles;
  const Lattice lattice{{0, 0, 0}, 0x1p-10};
  const std::vector<VertexColor> palette(3, {255, 255, 255, 255});
  std::vector<HlodSource> sources(2);
  for (uint32_t leaf = 0; leaf < 2; ++leaf) {
    Surface& surface = sources[leaf].surface = awkward::surface_of(awkward::grid(6, 1, 0.01));
    for (glm::ivec3& point : surface.points) point.x += static_cast<int>(leaf) * 1024;
    sources[leaf].spans.assign(surface.points.size(), {leaf, last, std::numeric_limits<float>::infinity()});
  }
  const UnitResult result = hlod_unit(std::move(sources), 0, 0, 2, {},
                                      HlodPlace{.options = options, .lattice = lattice, .palette = palette});
  return {result.chunks.size(), record_of<HlodFigures>(result.figures, "a test"),
          record_of<Baked>(result.geometry.at(0), "a test")};
}

TEST(Hlod, without_what_is_held_has_levels) {
  const Made made = make(1);
  EXPECT_GT(made.chunks, 0u);
  EXPECT_EQ(made.figures.errors.size(), made.chunks);
  EXPECT_LE(made.coarsest.surface.triangles.size(), 64u);
}

TEST(Hlod, that_draws_as_much_as_its_children_has_none_and_its_parent_begins_with_all_of_them) {
  const Made made = make(5);
  EXPECT_EQ(made.chunks, 0u);
  EXPECT_TRUE(made.figures.errors.empty());
  EXPECT_EQ(made.coarsest.surface.triangles.size(), 144u);
  EXPECT_EQ(make(5, 200).chunks, 1u) << "no more than was asked for: one drawable in place of two";
}

}  // namespace
}  // namespace triptych
