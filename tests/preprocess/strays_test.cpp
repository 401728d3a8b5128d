// What lies far from everything else: it is named, and does not move the near plane.
#include "preprocess/strays.hpp"

#include "scene/finest_boxes.hpp"
#include "scene/pack.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace triptych {
namespace {

ObjectExtent object(const glm::dvec3& lo, double size, uint64_t triangles) {
  return {{lo, lo + glm::dvec3(size)}, triangles};
}

std::vector<ObjectExtent> street() {
  std::vector<ObjectExtent> objects;
  for (int i = 0; i < 200; ++i) objects.push_back(object({i * 1.0, i % 3, 0}, 2, 100));
  return objects;
}

TEST(Strays, are_named_the_farthest_first) {
  std::vector<ObjectExtent> objects = street();
  EXPECT_TRUE(strays(objects).empty());
  objects.push_back(object({50'000, 0, 0}, 1, 20));
  objects.push_back(object({0, 0, -200'000}, 1, 20));
  EXPECT_EQ(strays(objects), (std::vector<uint32_t>{201, 200}));
}

TEST(Strays, are_not_what_is_large_or_near_or_as_much_as_the_rest) {
  std::vector<ObjectExtent> objects = street();
  objects.push_back(object({-1e6, -1e6, -1}, 2e6, 2));  // the ground
  objects.push_back(object({900, 0, 0}, 1, 20));
  EXPECT_TRUE(strays(objects).empty());
  const std::vector<ObjectExtent> two = {object({0, 0, 0}, 1, 500), object({1e6, 0, 0}, 1, 500)};
  EXPECT_TRUE(strays(two).empty());
}

TEST(Strays, of_no_objects_of_one_and_of_points_are_none) {
  EXPECT_TRUE(strays({}).empty());
  EXPECT_TRUE(strays(std::vector{object({0, 0, 0}, 1, 5)}).empty());
  EXPECT_TRUE(strays(std::vector(3, object({1, 1, 1}, 0, 1))).empty());
}

TEST(Strays, of_groups_in_groups_are_found_however_often_those_multiply) {
  constexpr uint32_t depth = 64;  // 2^64 placements of one mesh
  Model model;
  model.meshes.push_back(awkward::box({0, 0, 0}, {1, 1, 1}, 0));
  BuildPlan plan;
  plan.meshes.push_back(
      {.mesh = 0, .transform = Affine(1), .instances = {0}, .box = {{0, 0, 0}, {1, 1, 1}}, .triangles = 12});
  plan.instances.push_back({});
  for (uint32_t i = 0; i <= depth; ++i) {
    PlannedHierarchy hierarchy{
        .transforms = {Affine(1)}, .stretches = {}, .sub_hierarchies = {}, .box = plan.meshes[0].box};
    if (i > 0) hierarchy.sub_hierarchies = {{i - 1, 0}, {i - 1, 0}};
    plan.hierarchies.push_back(hierarchy);
  }
  EXPECT_FALSE(stray_warning(model, plan));
  plan.meshes.push_back({.mesh = 0,
                         .transform = Affine(1),
                         .instances = {1},
                         .box = {{5000, 0, 0}, {5001, 1, 1}},
                         .triangles = 12});
  plan.instances.push_back({.mesh = 1, .transform = 0, .hierarchy = depth});
  EXPECT_TRUE(stray_warning(model, plan));
}

TEST(Strays, of_a_hierarchy_that_is_a_list_do_not_move_the_near_plane) {
  constexpr uint32_t nodes = 200'000;
  Skeleton skeleton;
  skeleton.lattices = {Lattice{{0, 0, 0}, 1.0 / 1024}};
  for (uint32_t i = 0; i < nodes; ++i) {  // a leaf of one unit, and all others, twice as far apart
    const int far = static_cast<int>(nodes - i) * 1024;
    skeleton.scene_nodes.push_back({.box = {{0, 0, 0}, {i % 2 == 0 ? far * 2 : 1, 1, 1}},
                                    .parent = i == 0 ? no_id : i - (i % 2 == 0 ? 2 : 1),
                                    .first_child = i + 1,
                                    .child_count = i % 2 == 0 && i + 2 < nodes ? 2u : 0u});
  }
  skeleton.drawables.push_back({});
  EXPECT_DOUBLE_EQ(skeleton.default_near(), skeleton.lattice().step);  // small against a leaf
}

/// Boxes in rows, and perhaps one more.
Model rows(const glm::dvec3& stray, bool with_stray) {
  Model model = awkward::model_of({});
  for (int i = 0; i < 150; ++i) {
    const glm::dvec3 at(i % 15 * 2, i / 15 * 2, 0);
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    model.meshes.push_back(awkward::box(at, at + glm::dvec3(1), 0));
  }
  if (with_stray) {
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    model.meshes.push_back(awkward::box(stray, stray + glm::dvec3(1), 0));
    model.meshes.back().name = "crane hook";
  }
  return model;
}

TEST(Strays, are_a_warning_of_the_build_and_leave_the_near_plane_where_it_was) {
  const auto file = std::filesystem::path(testing::TempDir()) / "triptych_strays.tpk";
  const auto build = [&](bool with_stray) {
    build_pack(rows({200'000, 0, 0}, with_stray), {}, file);
    return Pack(file).skeleton();
  };
  const Skeleton without = build(false), with = build(true);
  EXPECT_TRUE(without.import.warnings.empty());
  ASSERT_EQ(with.import.warnings.size(), 1u);
  EXPECT_NE(with.import.warnings[0].find("crane hook"), std::string::npos);
  EXPECT_NEAR(without.default_near(), 1e-4 * diagonal(model_box(without)), 1e-9);
  EXPECT_LE(with.default_near(), 2 * without.default_near());
  EXPECT_GT(with.default_near(), 0);
}

}  // namespace
}  // namespace triptych
