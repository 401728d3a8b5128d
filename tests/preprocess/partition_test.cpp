#include "preprocess/partition.hpp"

#include "tests/support/awkward_meshes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

void expect_each_once(const std::vector<std::vector<uint32_t>>& parts, size_t count) {
  std::vector<int> seen(count, 0);
  for (const auto& part : parts) {
    EXPECT_FALSE(part.empty());
    for (const uint32_t index : part) ++seen.at(index);
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
}

TEST(Partition, every_triangle_is_in_one_part_and_no_part_is_too_large) {
  for (const Mesh& mesh : {awkward::sphere(30), awkward::grid(40), awkward::soup(3000), awkward::book(5)}) {
    const Surface surface = awkward::surface_of(mesh);
    PartitionLimits limits;
    limits.triangles = 100;
    const auto parts = partition_triangles(surface, limits);
    expect_each_once(parts, surface.triangles.size());
    for (const auto& part : parts) EXPECT_LE(part.size(), 100u) << mesh.name;
    EXPECT_LE(parts.size(), surface.triangles.size() / 20) << mesh.name << ": parts of uneven size";
  }
}

TEST(Partition, a_thousand_triangles_in_one_place_are_parted_all_the_same) {
  Mesh mesh{"fan", {{0, 0, 0}}, {}};
  for (uint32_t i = 0; i < 1000; ++i) {  // centres all on one line, many of them equal
    mesh.positions.push_back({1, double(i % 3), 0});
    mesh.positions.push_back({-1, -double(i % 3), 1});
    mesh.triangles.push_back({{0, 2 * i + 1, 2 * i + 2}, 0});
  }
  Surface surface;  // not welded: copies stay
  for (const glm::dvec3& p : mesh.positions) surface.points.push_back(glm::ivec3(p));
  surface.triangles = mesh.triangles;
  PartitionLimits limits;
  limits.triangles = 10;
  const auto parts = partition_triangles(surface, limits);
  expect_each_once(parts, 1000);
  for (const auto& part : parts) EXPECT_LE(part.size(), 10u);
}

TEST(Partition, a_vast_part_is_split_while_it_holds_many_triangles) {
  const Surface surface = awkward::surface_of(awkward::grid(64, 100));
  PartitionLimits limits;
  EXPECT_EQ(partition_triangles(surface, limits).size(), 1u);
  limits.diagonal = 60 * 1024.0;
  limits.large_triangles = 500;
  EXPECT_EQ(partition_triangles(surface, limits).size(), 8u);
  limits.large_triangles = 10000;
  EXPECT_EQ(partition_triangles(surface, limits).size(), 1u);
}

TEST(Partition, objects_are_parted_by_triangles_but_never_cut) {
  std::vector<ObjectExtent> objects;
  std::vector<uint32_t> all;
  for (uint32_t i = 0; i < 100; ++i) {
    objects.push_back({{{i, 0, 0}, {i + 0.5, 1, 1}}, 100});
    all.push_back(i);
  }
  const auto parts = partition_objects(objects, all, 1000);
  expect_each_once(parts, 100);
  for (const auto& part : parts) EXPECT_LE(part.size(), 10u);
  EXPECT_EQ(partition_objects(objects, all, 1).size(), 100u);
}

}  // namespace
}  // namespace triptych
