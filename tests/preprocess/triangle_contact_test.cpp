// Contacts of triangles against distances that are computed another way.
#include "preprocess/triangle_contact.hpp"

#include "tests/support/distance_judge.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

using judge::Corners;
using scenes::Random;
using LatticeCorners = std::array<glm::ivec3, 3>;

/// The distance of two segments (Ericson, Real-time collision detection, 2005).
double distance_of(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r, const glm::dvec3& s) {
  const glm::dvec3 d1 = q - p, d2 = s - r, between = p - r;
  const double a = glm::dot(d1, d1), e = glm::dot(d2, d2), f = glm::dot(d2, between),
               c = glm::dot(d1, between), b = glm::dot(d1, d2), denominator = a * e - b * b;
  double along = denominator > 1e-9 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  double other = (b * along + f) / e;
  if (other < 0 || other > 1) {
    other = std::clamp(other, 0.0, 1.0);
    along = std::clamp((b * other - c) / a, 0.0, 1.0);
  }
  return glm::length(p + along * d1 - (r + other * d2));
}

bool pierces(const Corners& triangle, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double before = glm::dot(from - triangle[0], normal), behind = glm::dot(to - triangle[0], normal);
  if (before * behind > 0 || before == behind) return false;
  return judge::distance_to_triangle(from + (to - from) * (before / (before - behind)), triangle) < 1e-7;
}

double distance_of(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < 3; ++i) {
    least = std::min({least, judge::distance_to_triangle(b[i], a), judge::distance_to_triangle(a[i], b)});
    if (pierces(a, b[i], b[(i + 1) % 3]) || pierces(b, a[i], a[(i + 1) % 3])) return 0;
    for (size_t k = 0; k < 3; ++k)
      least = std::min(least, distance_of(a[i], a[(i + 1) % 3], b[k], b[(k + 1) % 3]));
  }
  return least;
}

Corners doubles(const LatticeCorners& corners) {
  return {glm::dvec3(corners[0]), glm::dvec3(corners[1]), glm::dvec3(corners[2])};
}

/// Of a triangle what is left if a little is cut off at each corner that the other has, too.
std::vector<Corners> without_shared(const LatticeCorners& corners, const LatticeCorners& other) {
  std::vector<glm::dvec3> outline;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 at(corners[i]), before(corners[(i + 2) % 3]), next(corners[(i + 1) % 3]);
    if (std::find(other.begin(), other.end(), corners[i]) == other.end()) {
      outline.push_back(at);
    } else {
      outline.push_back(glm::mix(at, before, 1e-3));
      outline.push_back(glm::mix(at, next, 1e-3));
    }
  }
  std::vector<Corners> pieces;
  for (size_t i = 2; i < outline.size(); ++i) pieces.push_back({outline[0], outline[i - 1], outline[i]});
  return pieces;
}

size_t shared(const LatticeCorners& a, const LatticeCorners& b) {
  return static_cast<size_t>(std::count_if(
      a.begin(), a.end(), [&](const auto& p) { return std::find(b.begin(), b.end(), p) != b.end(); }));
}

TEST(TriangleContact, of_random_triangles_is_what_their_distance_says) {
  Random random(5);
  std::array<std::array<size_t, 2>, 2> seen{};
  for (int i = 0; i < 60'000; ++i) {
    const int reach = i % 2 == 0 ? 3 : 12;
    const auto point = [&] {
      glm::ivec3 p(random.vector(-reach, reach));
      if (i % 5 == 0) p.z = 1;  // in one plane
      return p;
    };
    LatticeCorners a{point(), point(), point()}, b{point(), point(), point()};
    if (i % 3 == 0) b[static_cast<size_t>(i / 3 % 3)] = a[static_cast<size_t>(i / 9 % 3)];
    const ExactTriangle first(a), second(b);
    const size_t common = shared(a, b);
    if (first.is_degenerate() || second.is_degenerate() || common > 1) continue;
    double distance = std::numeric_limits<double>::infinity();
    for (const Corners& piece : without_shared(a, b))
      distance = std::min(distance, distance_of(piece, doubles(b)));
    const bool apart = distance > 1e-6;
    EXPECT_EQ(meet_only_where_shared(first, second), apart) << i << " at " << distance;
    EXPECT_EQ(meet_only_where_shared(second, first), apart) << i;
    ++seen[common][apart];
  }
  for (const auto& [meet, apart] : seen) {
    EXPECT_GT(meet, 500u);
    EXPECT_GT(apart, 500u);
  }
}

TEST(TriangleContact, at_an_edge_only_what_is_folded_onto_the_other_meets_it) {
  const LatticeCorners a{glm::ivec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}};
  const auto meets = [&](const glm::ivec3& apex) {
    return !meet_only_where_shared(ExactTriangle(a), ExactTriangle({a[1], a[0], apex}));
  };
  EXPECT_FALSE(meets({1, -3, 0}));
  EXPECT_FALSE(meets({1, 2, 1}));
  EXPECT_FALSE(meets({1, 0, 5}));
  EXPECT_TRUE(meets({1, 2, 0}));
  EXPECT_TRUE(meets({3, 9, 0}));
  EXPECT_TRUE(meets({0, 4, 0})) << "the same corners";
}

TEST(TriangleContact, volumes_have_exact_signs_at_the_ends_of_the_lattice) {
  constexpr int far = 1 << 29;
  const ExactTriangle triangle({glm::ivec3(-far, -far, -far), {far, -far, far - 1}, {-far, far, far}});
  const glm::ivec3 on = triangle.corners[1];
  EXPECT_EQ(triangle.volume_from(on), 0);
  EXPECT_GT(triangle.volume_from(on - glm::ivec3(0, 0, 1)), 0);
  EXPECT_LT(triangle.volume_from(on + glm::ivec3(0, 0, 1)), 0);
}

}  // namespace
}  // namespace triptych
