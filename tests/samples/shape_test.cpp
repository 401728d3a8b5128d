// Bars, bolts, tubes and turned bodies become as many triangles as they are given, closed and outward.
#include "samples/shape.hpp"

#include "tests/samples/mesh_edges.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

Faces faces_of(const MeshPart& part) {
  Faces faces(part.indices.size() / 3);
  for (size_t i = 0; i < faces.size(); ++i)
    faces[i] = {part.indices[3 * i], part.indices[3 * i + 1], part.indices[3 * i + 2]};
  return faces;
}

void expect_closed_and_outward(const Shape& shape, uint64_t triangles) {
  const MeshPart part = shape.mesh(triangles);
  const Faces faces = faces_of(part);
  for (const auto& [edge, use] : edges_of(faces)) {
    ASSERT_EQ(use.forwards, 1);
    ASSERT_EQ(use.backwards, 1);
  }
  EXPECT_GT(volume_of(part.positions, faces), 0);
}

TEST(Shape, every_kind_of_part_is_closed_and_outward) {
  const glm::dvec3 white(1);
  for (const uint64_t triangles : {1u, 500u, 20'000u}) {
    Shape box(white), bar(white), bolt(white), tube(white), turned(white), backwards(white);
    box.box({1, 2, 3}, {2, 4, 6});
    bar.bar({5, 0, 0}, {6, 2, 1}, 0.1, 0.3);
    bolt.bolt({0, 5, 0}, 0.1, 0.2);
    tube.tube({{0, 0, 0}, {0, 4, 0}, {3, 4, 0}, {3, 4, -5}}, 0.2);
    turned.turned({2, 2, 2}, 1, {{0, 0.2}, {0.5, 1}, {0.5, 1.2}, {2, 0.1}});
    backwards.turned({2, 2, 2}, 2, {{0, 0.2}, {-0.5, 1}, {-2, 0.1}});
    for (const Shape* shape : {&box, &bar, &bolt, &tube, &turned, &backwards})
      expect_closed_and_outward(*shape, triangles);
  }
}

TEST(Shape, a_bolt_has_20_triangles) {
  Shape shape(glm::dvec3(1));
  shape.bolt({0, 0, 0}, 0.1, 0.2);
  EXPECT_EQ(shape.mesh(5000).indices.size() / 3, 20u);
}

TEST(Shape, round_parts_come_as_near_to_the_budget_as_a_ring_allows) {
  Shape shape(glm::dvec3(1));
  for (int i = 0; i < 10; ++i) shape.tube({{i, 0, 0}, {i, 4 + i, 0}, {i, 4 + i, 3}}, 0.05 + 0.02 * i);
  for (const uint64_t triangles : {2'000u, 30'000u, 700'000u}) {
    const uint64_t made = shape.mesh(triangles).indices.size() / 3;
    EXPECT_LE(made, triangles);
    EXPECT_GT(made + 400, triangles);
  }
}

TEST(Shape, with_too_few_triangles_the_last_parts_are_left_out) {
  Shape shape(glm::dvec3(1));
  for (int i = 0; i < 10; ++i) shape.box(glm::dvec3(i), glm::dvec3(i + 0.5));
  EXPECT_EQ(shape.mesh(0).indices.size(), 36u);
  EXPECT_EQ(shape.mesh(59).indices.size(), 4 * 36u);
}

}  // namespace
}  // namespace triptych
