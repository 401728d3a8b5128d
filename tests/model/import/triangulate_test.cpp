#include "model/import/triangulate.hpp"

#include <cmath>
#include <ctime>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace triptych {
namespace {

using Polygon = std::vector<glm::dvec3>;

std::vector<std::array<uint32_t, 3>> cut(const Polygon& polygon) {
  std::vector<std::array<uint32_t, 3>> triangles = {{9, 9, 9}};
  triangulate(polygon, triangles);
  return triangles;
}

glm::dvec3 newell(const Polygon& polygon) {
  glm::dvec3 sum{0};
  for (size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum / 2.0;
}

/// The triangles' areas, each counted positive, add up to the face's: none is turned over, none lies outside.
void expect_cover(const Polygon& polygon) {
  const auto triangles = cut(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const glm::dvec3 whole = newell(polygon), normal = whole / glm::length(whole);
  double area = 0;
  for (const auto& [a, b, c] : triangles) {
    const double part = glm::dot(newell({polygon[a], polygon[b], polygon[c]}), normal);
    EXPECT_GE(part, -1e-9 * glm::length(whole));
    area += std::abs(part);
  }
  EXPECT_NEAR(area, glm::length(whole), 1e-9 * glm::length(whole));
}

TEST(Triangulate, a_triangle_stays_and_a_convex_face_is_the_fan_of_its_first_corner) {
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}), (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}}));
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}),
            (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut({{0, 0, 5}, {2, 0, 5}, {3, 1, 5}, {1, 3, 5}, {-1, 1, 5}}),
            (std::vector<std::array<uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
  EXPECT_TRUE(cut({{0, 0, 0}, {1, 0, 0}}).empty());
  EXPECT_TRUE(cut({}).empty());
}

TEST(Triangulate, a_concave_quad_is_cut_along_the_diagonal_within) {
  for (size_t first = 0; first < 4; ++first) {  // the dart's inner corner in every place
    const Polygon dart = {{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}};
    Polygon turned;
    for (size_t i = 0; i < 4; ++i) turned.push_back(dart[(first + i) % 4]);
    expect_cover(turned);
  }
}

TEST(Triangulate, concave_faces_in_any_plane_are_covered_without_overlap) {
  const Polygon comb = {{0, 0, 0}, {7, 0, 0}, {7, 5, 0}, {6, 5, 0}, {6, 1, 0}, {5, 1, 0},
                        {5, 5, 0}, {4, 5, 0}, {4, 1, 0}, {3, 1, 0}, {3, 5, 0}, {2, 5, 0},
                        {2, 1, 0}, {1, 1, 0}, {1, 5, 0}, {0, 5, 0}};
  expect_cover(comb);
  Polygon tilted, far, back;
  for (const glm::dvec3& p : comb) {
    tilted.push_back({p.x, p.y + 2 * p.x, 3 * p.y - p.x});
    far.push_back({p.z + 1e6, 1e-3 * p.x, 1e-3 * p.y});
    back.insert(back.begin(), p);
  }
  expect_cover(tilted);
  expect_cover(far);
  expect_cover(back);
}

TEST(Triangulate, random_stars_with_many_corners_are_covered) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    Polygon star;
    const int corners = 5 + round * 7;
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * i / corners,
                   radius = 1 + static_cast<double>(random() % 1000) / 100;
      star.push_back({radius * std::cos(angle), 3, radius * std::sin(angle)});
    }
    expect_cover(star);
  }
}

TEST(Triangulate, corners_in_a_line_and_a_hole_with_a_bridge_are_covered) {
  expect_cover({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  expect_cover({{0, 0, 0},
                {9, 0, 0},
                {9, 9, 0},
                {0, 9, 0},
                {0, 0, 0},
                {3, 3, 0},
                {3, 6, 0},
                {6, 6, 0},
                {6, 3, 0},
                {3, 3, 0}});
}

TEST(Triangulate, a_face_that_is_not_planar_keeps_its_outline) {
  const Polygon saddle = {{0, 0, 0}, {4, 0, 1}, {1.2, 1, -0.5}, {4, 4, 0}, {0, 4, 1}};
  const auto triangles = cut(saddle);
  ASSERT_EQ(triangles.size(), 3u);
  glm::dvec3 sum{0};
  for (const auto& [a, b, c] : triangles) sum += newell({saddle[a], saddle[b], saddle[c]});
  EXPECT_NEAR(glm::length(sum - newell(saddle)), 0, 1e-12);
}

TEST(Triangulate, what_has_no_ears_still_gives_its_number_of_triangles) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).size(), 3u);       // a line
  EXPECT_EQ(cut(Polygon(6, glm::dvec3(1, 2, 3))).size(), 4u);                               // a point
  EXPECT_EQ(cut({{0, 0, 0}, {none, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0.5, 0}}).size(), 3u);  // not finite
  EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 2, 0}}).size(), 3u);     // crosses itself
  EXPECT_EQ(cut({{0, 1, 0}, {0.6, -0.8, 0}, {-0.95, 0.3, 0}, {0.95, 0.3, 0}, {-0.6, -0.8, 0}}).size(), 3u);
}

/// 4,096 corners of three kinds: a star, a comb, and a spiral.
TEST(Triangulate, a_face_of_4096_corners_takes_less_than_a_tenth_of_a_second) {
  const double pi = std::acos(-1.0);
  Polygon star, comb, spiral;
  for (int i = 0; i < 4096; ++i) {
    const double angle = 2 * pi * i / 4096, radius = i % 2 ? 1 : 3;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    comb.push_back(i < 2048 ? glm::dvec3(i, i % 2 ? 100 : 1, 0) : glm::dvec3(4095 - i, i % 2 ? -1 : -100, 0));
    const double along = (i < 2048 ? i : 4095 - i) / 2048.0, out = 1 + 20 * along + (i < 2048 ? 0.4 : 0);
    spiral.push_back({out * std::cos(40 * pi * along), out * std::sin(40 * pi * along), 0});
  }
  for (const Polygon* polygon : {&star, &comb, &spiral}) {
    const std::clock_t begin = std::clock();  // of this process: other ones may take the processor
    const auto triangles = cut(*polygon);
    const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_EQ(triangles.size(), 4094u);
    EXPECT_LT(seconds, 0.1);
  }
  expect_cover(star);
  expect_cover(spiral);
}

TEST(Triangulate, a_face_of_very_many_corners_does_not_take_long) {
  Polygon comb;
  for (int i = 0; i < 200000; ++i) comb.push_back({i, i % 2, 0});
  comb.push_back({100000, -5, 0});
  EXPECT_EQ(cut(comb).size(), comb.size() - 2);
  comb.resize(4000);
  EXPECT_EQ(cut(comb).size(), comb.size() - 2);
}

}  // namespace
}  // namespace triptych
