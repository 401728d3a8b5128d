#include "preprocess/contacts/inner_faces.hpp"

#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

/// Surfaces as one, equal points joined.
Surface joined(const std::vector<Surface>& surfaces) {
  Surface all;
  std::map<std::array<int, 3>, uint32_t> numbers;
  for (const Surface& surface : surfaces) {
    for (Triangle triangle : surface.triangles) {
      for (uint32_t& vertex : triangle.vertices) {
        const glm::ivec3& point = surface.points[vertex];
        const auto [found, inserted] =
            numbers.try_emplace({point.x, point.y, point.z}, static_cast<uint32_t>(all.points.size()));
        if (inserted) all.points.push_back(point);
        vertex = found->second;
      }
      all.triangles.push_back(triangle);
    }
  }
  return all;
}

Surface box(const glm::dvec3& low, const glm::dvec3& high) {
  return awkward::surface_of(awkward::box(low, high, 1));
}

/// The triangles that face along x at this place.
size_t faces_at(const Surface& surface, int x) {
  return static_cast<size_t>(std::ranges::count_if(surface.triangles, [&](const Triangle& triangle) {
    return std::ranges::all_of(triangle.vertices,
                               [&](uint32_t vertex) { return surface.points[vertex].x == x; });
  }));
}

size_t inner_count(const Surface& surface) {
  return static_cast<size_t>(
      std::ranges::count_if(find_inner_faces(surface), [](double reach) { return reach >= 0; }));
}

TEST(InnerFaces, are_those_between_boxes_that_stand_in_a_row) {
  const Surface row =
      joined({box({0, 0, 0}, {4, 1, 1}), box({4, 0, 0}, {8, 1, 1}), box({8, 0, 0}, {12, 1, 1})});
  ASSERT_EQ(faces_at(row, 4096), 4u);
  const std::vector<double> reaches = find_inner_faces(row);
  for (size_t i = 0; i < reaches.size(); ++i) {
    const auto& [a, b, c] = row.triangles[i].vertices;
    const int x = row.points[a].x;
    const bool is_across = row.points[b].x == x && row.points[c].x == x;
    EXPECT_EQ(reaches[i] >= 0, is_across && (x == 4096 || x == 8192)) << i;
    // No point of half a square is further from its sides than they are long.
    EXPECT_LE(reaches[i], 1024.001);
  }
}

TEST(InnerFaces, are_found_whichever_way_quadrangles_are_divided) {
  const Surface left = box({0, 0, 0}, {4, 1, 1});
  Surface right = box({4, 0, 0}, {8, 1, 1});
  // Divide its face on x = 4 by the other diagonal.
  std::vector<size_t> faces;
  for (size_t i = 0; i < right.triangles.size(); ++i) {
    if (std::ranges::all_of(right.triangles[i].vertices,
                            [&](uint32_t v) { return right.points[v].x == 4096; }))
      faces.push_back(i);
  }
  ASSERT_EQ(faces.size(), 2u);
  const auto& [a, b, c] = right.triangles[faces[0]].vertices;
  const auto& other = right.triangles[faces[1]].vertices;
  const uint32_t d = *std::ranges::find_if(
      other, [&](uint32_t vertex) { return vertex != a && vertex != b && vertex != c; });
  std::array<uint32_t, 4> around;  // in the order of the face, from a corner that is not on the diagonal
  if (std::ranges::count(other, a) == 0)
    around = {a, b, d, c};
  else if (std::ranges::count(other, b) == 0)
    around = {b, c, d, a};
  else
    around = {c, a, d, b};
  right.triangles[faces[0]].vertices = {around[0], around[1], around[2]};
  right.triangles[faces[1]].vertices = {around[0], around[2], around[3]};
  EXPECT_EQ(inner_count(joined({left, right})), 4u);
}

TEST(InnerFaces, sheets_with_two_sides_are_none) {
  Surface sheet = awkward::surface_of(awkward::grid(4));
  Surface back = sheet;
  for (Triangle& triangle : back.triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  EXPECT_EQ(inner_count(joined({sheet, back})), 0u);
}

TEST(InnerFaces, a_wall_between_rooms_is_none) {
  // Boxes inside out: the eye is in them.
  Surface one = box({0, 0, 0}, {4, 1, 1}), other = box({4, 0, 0}, {8, 1, 1});
  for (Surface* room : {&one, &other}) {
    for (Triangle& triangle : room->triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  }
  EXPECT_EQ(inner_count(joined({one, other})), 0u);
}

TEST(InnerFaces, bodies_that_are_open_have_none) {
  Surface one = box({0, 0, 0}, {4, 1, 1});
  std::erase_if(one.triangles, [&](const Triangle& triangle) {
    return std::ranges::all_of(triangle.vertices, [&](uint32_t vertex) { return one.points[vertex].x == 0; });
  });
  EXPECT_EQ(inner_count(joined({one, box({4, 0, 0}, {8, 1, 1})})), 0u);
}

TEST(InnerFaces, faces_of_different_sizes_are_none) {
  EXPECT_EQ(inner_count(joined({box({0, 0, 0}, {4, 1, 1}), box({4, 0, 0}, {8, 2, 1})})), 0u);
}

TEST(InnerFaces, only_near_ones_are_marked) {
  Surface row = joined({box({0, 0, 0}, {4, 1, 1}), box({4, 0, 0}, {8, 1, 1})});
  Surface left = row;
  mark_inner_faces(left, 500);
  EXPECT_EQ(left.triangles, row.triangles);
  mark_inner_faces(row, 1200);
  EXPECT_EQ(std::ranges::count_if(
                row.triangles, [](const Triangle& triangle) { return covered_class(triangle.material) > 0; }),
            4);
}

}  // namespace
}  // namespace triptych
