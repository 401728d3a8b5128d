#include "preprocess/cluster.hpp"

#include "simplify/neighbours.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace triptych {
namespace {

/// Emptiness in a box costs nothing.
constexpr double any_cost = std::numeric_limits<double>::infinity(), any_volume = any_cost;

/// Unit boxes in a square block of side × side around `at`, half a unit apart.
void add_block(std::vector<ObjectExtent>& objects, const glm::dvec3& at, int side) {
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      const glm::dvec3 lo = at + glm::dvec3(x, y, 0) * 1.5;
      objects.push_back({{lo, lo + 1.0}, 100});
    }
  }
}

TEST(Cluster, two_groups_far_apart_stay_two_groups) {
  std::vector<ObjectExtent> objects;
  add_block(objects, {0, 0, 0}, 4);
  add_block(objects, {40, 0, 0}, 4);
  const auto clusters = cluster_objects(objects, {1000000, 0.05, any_cost, any_volume, 12});
  ASSERT_EQ(clusters.size(), 2u);
  for (uint32_t i = 0; i < 16; ++i) {
    EXPECT_EQ(clusters[0][i], i);
    EXPECT_EQ(clusters[1][i], i + 16);
  }
}

TEST(Cluster, no_cluster_has_more_triangles_than_the_limit) {
  std::vector<ObjectExtent> objects;
  add_block(objects, {0, 0, 0}, 12);
  for (const auto& cluster : cluster_objects(objects, {800, 10, any_cost, any_volume, 12}))
    EXPECT_LE(cluster.size(), 8u);
}

TEST(Cluster, a_slab_does_not_swallow_what_stands_on_it) {
  const std::vector<ObjectExtent> objects = {{{{0, 0, 0}, {20, 0.3, 20}}, 12},
                                             {{{9, 0.3, 9}, {10, 1, 10}}, 12}};
  EXPECT_EQ(cluster_objects(objects, {800, 1e9, any_cost, any_volume, 12}).size(), 1u);
  EXPECT_EQ(cluster_objects(objects, {800, 1e9, any_cost, 1.5, 12}).size(), 2u);
}

TEST(Cluster, a_hundred_thousand_objects_at_one_place_make_few_clusters) {
  const std::vector<ObjectExtent> objects(100'000, ObjectExtent{{{0, 0, 0}, {1, 1, 1}}, 12});
  const auto clusters = cluster_objects(objects, {16384, 1, any_cost, any_volume, 12});
  size_t members = 0;
  for (const auto& cluster : clusters) {
    members += cluster.size();
    EXPECT_LE(cluster.size(), 16384u / 12);
  }
  EXPECT_EQ(members, 100'000u);
  EXPECT_LE(clusters.size(), 2 * 100'000u * 12 / 16384);
}

TEST(Cluster, what_would_make_a_box_of_air_stays_apart_and_so_does_what_is_dear_to_draw) {
  // Two slabs that meet in a corner: their common box has far more surface than they have.
  for (const uint64_t triangles : {5000u, 4u}) {
    const std::vector<ObjectExtent> corner = {{{{0, 0, 0}, {10, 1, 10}}, triangles},
                                              {{{0, 0, 0}, {1, 10, 10}}, triangles}};
    EXPECT_EQ(cluster_objects(corner, {1000000, 100, 1, any_volume, 12}).size(), 2u) << triangles;
  }
  // Two halves of one box, with few triangles and with many.
  for (const uint64_t triangles : {5000u, 4u}) {
    const std::vector<ObjectExtent> halves = {{{{0, 0, 0}, {10, 1, 10}}, triangles},
                                              {{{0, 1, 0}, {10, 2, 10}}, triangles}};
    EXPECT_EQ(cluster_objects(halves, {1000000, 100, 1, any_volume, 12}).size(), triangles > 32 ? 2u : 1u);
  }
}

TEST(Cluster, one_object_and_none) {
  EXPECT_TRUE(cluster_objects({}, {}).empty());
  EXPECT_EQ(cluster_objects(std::vector<ObjectExtent>(1), {}).size(), 1u);
}

TEST(Neighbours, are_the_nearest_that_a_plain_search_finds) {
  std::mt19937 random(7);
  std::vector<glm::dvec3> points;
  for (int i = 0; i < 500; ++i) points.push_back({random() % 50, random() % 50, random() % 3});
  const auto neighbours = nearest_neighbours(points, 5);
  const auto apart = [&](size_t a, size_t b) {
    const glm::dvec3 d = points[a] - points[b];
    return d.x * d.x + d.y * d.y + d.z * d.z;
  };
  for (size_t i = 0; i < points.size(); ++i) {
    std::vector<double> distances;
    for (size_t j = 0; j < points.size(); ++j) {
      if (j != i) distances.push_back(apart(i, j));
    }
    std::sort(distances.begin(), distances.end());
    ASSERT_EQ(neighbours[i].size(), 5u);
    for (size_t k = 0; k < 5; ++k) EXPECT_EQ(apart(i, neighbours[i][k]), distances[k]);
  }
}

}  // namespace
}  // namespace triptych
