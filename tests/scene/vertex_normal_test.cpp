// Directions in 32 bits.
#include "scene/vertex_normal.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace triptych {
namespace {

TEST(VertexNormal, is_a_direction_to_a_sixth_of_a_degree) {
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  double least = 1;
  for (int i = 0; i < 100'000; ++i) {
    const glm::dvec3 direction(number(random), number(random), number(random));
    const VertexNormal normal = to_vertex_normal(direction * 1e-3);
    ASSERT_TRUE(is_vertex_normal(normal));
    const glm::dvec3 back = direction_of(normal);
    EXPECT_GE(glm::length(back), 0.5);
    EXPECT_LE(glm::length(back), 1 + 1e-9);
    least = std::min(least, glm::dot(glm::normalize(back), glm::normalize(direction)));
  }
  EXPECT_GT(least, std::cos(glm::radians(0.15)));
}

TEST(VertexNormal, of_an_axis_is_that_axis) {
  for (const glm::dvec3& axis :
       {glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}})
    EXPECT_EQ(direction_of(to_vertex_normal(axis)), axis);
}

TEST(VertexNormal, of_what_is_no_direction_is_none) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(has_normal(to_vertex_normal(glm::dvec3(0))));
  EXPECT_FALSE(has_normal(to_vertex_normal(glm::dvec3(infinity, 0, 0))));
  EXPECT_FALSE(has_normal(to_vertex_normal(glm::dvec3(std::nan(""), 1, 0))));
  EXPECT_FALSE(has_normal(VertexNormal{}));
  EXPECT_FALSE(is_vertex_normal({2048, 5}));
  EXPECT_FALSE(is_vertex_normal({5, 0}));
}

}  // namespace
}  // namespace triptych
