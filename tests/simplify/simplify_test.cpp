#include "simplify/simplify.hpp"

#include "simplify/vertex_clustering.hpp"
#include "tests/support/distance_judge.hpp"
#include "tests/support/hard_surfaces.hpp"

#include <gtest/gtest.h>
#include <set>

namespace triptych {
namespace {

constexpr std::array<Simplifier, 3> simplifiers = {Simplifier::collapse, Simplifier::openmesh,
                                                   Simplifier::meshopt};

std::string name_of(Simplifier simplifier, Bound bound) {
  return std::array{"collapse", "openmesh", "meshopt"}[static_cast<size_t>(simplifier)] +
         std::string(bound == Bound::fast ? " fast" : " tight");
}

TEST(Simplify, halves_until_the_target_with_bounds_that_hold_and_grow) {
  for (const Simplifier simplifier : simplifiers) {
    for (const Bound bound : {Bound::fast, Bound::tight}) {
      for (const auto& [name, surface] : hard::surfaces()) {
        SimplifyLimits limits;
        limits.triangles = 40;
        limits.simplifier = simplifier;
        limits.bound = bound;
        limits.keep_cover = bound == Bound::fast;  // both with and without
        const Chain chain = simplify(surface, {}, limits);
        const std::string which = name + ", " + name_of(simplifier, bound);
        ASSERT_FALSE(chain.levels.empty()) << which;
        EXPECT_FALSE(chain.stuck) << which;
        size_t before = surface.triangles.size();
        double bound_before = 0;
        for (const Level& level : chain.levels) {
          EXPECT_LE(level.piece.surface.triangles.size(), before * 3 / 4) << which;
          EXPECT_GE(level.bound, bound_before) << which;
          EXPECT_LE(judge::distance(surface, level.piece.surface, 500), level.bound + 1e-6) << which;
          before = level.piece.surface.triangles.size();
          bound_before = level.bound;
        }
        EXPECT_LE(before, 40u) << which;
      }
    }
  }
}

TEST(Simplify, has_tight_bounds_no_larger_than_fast_ones_and_near_the_truth) {
  for (const Simplifier simplifier : simplifiers) {
    for (const Surface& surface :
         {awkward::surface_of(awkward::sphere(14, 4)), awkward::surface_of(awkward::grid(20, 4, 0.5))}) {
      SimplifyLimits limits;
      limits.simplifier = simplifier;
      const Chain fast = simplify(surface, {}, limits);
      limits.bound = Bound::tight;
      const Chain tight = simplify(surface, {}, limits);
      ASSERT_EQ(fast.levels.size(), tight.levels.size());
      for (size_t i = 0; i < fast.levels.size(); ++i) {
        ASSERT_EQ(fast.levels[i].piece.surface.triangles, tight.levels[i].piece.surface.triangles);
        EXPECT_LE(tight.levels[i].bound, fast.levels[i].bound);
        EXPECT_LE(tight.levels[i].bound, 2 * judge::distance(surface, tight.levels[i].piece.surface) + 0.3);
      }
    }
  }
}

TEST(Simplify, keeps_locked_points_at_every_level) {
  const Surface surface = awkward::surface_of(awkward::grid(24, 1, 0.1));
  std::vector<uint8_t> locked(surface.points.size(), 0);
  for (size_t i = 0; i < locked.size(); ++i) {
    locked[i] = surface.points[i].x == 0 || (surface.points[i].x > 300 && surface.points[i].x < 350);
  }
  for (const Simplifier simplifier : simplifiers) {
    SimplifyLimits limits;
    limits.triangles = 200;
    limits.simplifier = simplifier;
    const Chain chain = simplify(surface, locked, limits);
    ASSERT_FALSE(chain.levels.empty());
    EXPECT_LT(chain.levels.back().piece.surface.triangles.size(), 400u);
    for (const Level& level : chain.levels) {
      const std::set<uint32_t> kept(level.piece.sources.begin(), level.piece.sources.end());
      for (uint32_t i = 0; i < locked.size(); ++i) EXPECT_TRUE(!locked[i] || kept.contains(i));
      for (size_t i = 0; i < level.piece.sources.size(); ++i) {
        EXPECT_EQ(level.piece.surface.points[i], surface.points[level.piece.sources[i]]);
      }
    }
  }
}

TEST(Simplify, merges_thousands_of_bolts_to_any_target) {
  const Surface surface = awkward::surface_of(hard::shelf(300));
  for (const Simplifier simplifier : simplifiers) {
    SimplifyLimits limits;
    limits.triangles = 50;
    limits.colors = Colors::ignore;
    limits.simplifier = simplifier;
    const Chain chain = simplify(surface, {}, limits);
    EXPECT_FALSE(chain.stuck);
    ASSERT_FALSE(chain.levels.empty());
    EXPECT_LE(chain.levels.back().piece.surface.triangles.size(), 50u);
    for (const Level& level : chain.levels) {
      EXPECT_LE(judge::distance_without_colors(surface, level.piece.surface, 500), level.bound + 1e-6);
    }
  }
}

TEST(Simplify,
     a_heap_of_small_things_is_clustered_where_each_would_be_left_few_triangles_and_a_single_thing_is_not) {
  Mesh heap{"heap", {}, {}};
  for (int i = 0; i < 60; ++i) {
    const glm::dvec3 corner(i % 8, i / 8, i % 3);
    awkward::append(heap, awkward::box(corner, corner + glm::dvec3(0.6)));
  }
  SimplifyLimits limits;
  limits.colors = Colors::ignore;
  const auto is_clustered = [&](const Surface& from, const Level& level, std::span<const uint8_t> locked,
                                size_t goal) {
    return level.piece.surface.triangles ==
           cluster_to(from, locked, goal, limits.colors).piece.surface.triangles;
  };
  const auto first_is_clustered = [&](const Surface& surface, std::span<const uint8_t> locked) {
    const Chain chain = simplify(surface, locked, limits);
    return !chain.levels.empty() &&
           is_clustered(surface, chain.levels[0], locked, surface.triangles.size() / 2);
  };
  const Surface boxes = awkward::surface_of(heap), sphere = awkward::surface_of(awkward::sphere(8));
  // Halves have six triangles a box, quarters would have three.
  const Chain chain = simplify(boxes, {}, limits);
  ASSERT_GE(chain.levels.size(), 2u);
  const Surface& half = chain.levels[0].piece.surface;
  EXPECT_FALSE(first_is_clustered(boxes, {}));
  EXPECT_TRUE(is_clustered(half, chain.levels[1], {}, half.triangles.size() / 2));
  EXPECT_FALSE(first_is_clustered(sphere, {}));
  // With a border everywhere they are pieces of something larger.
  std::vector<uint8_t> locked(boxes.points.size(), 0);
  for (size_t i = 0; i < locked.size(); i += 8) locked[i] = 1;
  EXPECT_FALSE(first_is_clustered(boxes, locked));
  limits.colors = Colors::keep;
  EXPECT_FALSE(first_is_clustered(boxes, {}));
}

TEST(Simplify, ends_before_a_level_beyond_the_largest_bound) {
  const Surface surface = awkward::surface_of(awkward::sphere(14, 4));
  SimplifyLimits limits;
  limits.triangles = 4;
  limits.max_bound = 200;
  const Chain chain = simplify(surface, {}, limits);
  ASSERT_FALSE(chain.levels.empty());
  EXPECT_LE(chain.levels.back().bound, 200);
  EXPECT_GT(chain.levels.back().piece.surface.triangles.size(), 40u);
  EXPECT_FALSE(chain.stuck);
}

TEST(Simplify, a_smooth_sphere_is_cheap_to_halve) {
  const Surface surface = awkward::surface_of(awkward::sphere(40));
  for (const Simplifier simplifier : simplifiers) {
    SimplifyLimits limits;
    limits.triangles = surface.triangles.size() / 2;
    limits.simplifier = simplifier;
    const Chain chain = simplify(surface, {}, limits);
    ASSERT_EQ(chain.levels.size(), 1u);
    EXPECT_LE(chain.levels[0].bound, 1024 * 0.02);  // 2 % of the radius
  }
}

TEST(Simplify, leaves_a_single_triangle_alone) {
  const Surface surface = awkward::surface_of({"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0}}});
  EXPECT_TRUE(simplify(surface, {}, {}).levels.empty());
}

TEST(Simplify, gives_the_same_every_time) {
  const Surface surface = hard::checkers(16, 4, 0.5);
  for (const Simplifier simplifier : simplifiers) {
    SimplifyLimits limits;
    limits.simplifier = simplifier;
    const Chain first = simplify(surface, {}, limits), second = simplify(surface, {}, limits);
    ASSERT_EQ(first.levels.size(), second.levels.size());
    for (size_t i = 0; i < first.levels.size(); ++i) {
      EXPECT_EQ(first.levels[i].piece.surface.triangles, second.levels[i].piece.surface.triangles);
      EXPECT_EQ(first.levels[i].bound, second.levels[i].bound);
    }
  }
}

}  // namespace
}  // namespace triptych
