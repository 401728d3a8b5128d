// Builds of models in which groups repeat.
#include "base/file.hpp"
#include "model/flatten.hpp"
#include "preprocess/build.hpp"
#include "preprocess/check/check.hpp"
#include "preprocess/placements.hpp"
#include "scene/finest_boxes.hpp"
#include "scene/pack.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/drawable_triangles.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

const BuildOptions small_leaves{.part_triangles = 128, .leaf_triangles = 128, .hlod_triangles = 96};

std::filesystem::path file_of(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / ("triptych_instances_" + name + ".tpk");
}

BuildReport build(const Model& model, const std::string& name, const BuildOptions& options = small_leaves) {
  return build_pack(model, options, file_of(name));
}

void expect_sound(const std::string& name) {
  const Pack pack(file_of(name));
  const CheckReport report = check_pack(pack, {.points = 2'000'000});
  EXPECT_TRUE(report.sound()) << (report.messages.empty() ? "" : report.messages[0]);
  EXPECT_EQ(report.drawables_not_checked, 0u);
}

double area(const Pack& pack) {
  double sum = 0;
  for (const SceneNode& node : pack.skeleton().scene_nodes) {
    if (node.child_count > 0) continue;
    for (const auto& t : judge::triangles_of(pack, node.first_drawable))
      sum += glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
  }
  return sum;
}

/// Signed: what is turned inside out counts negative.
double volume(const std::vector<judge::Corners>& triangles) {
  double sum = 0;
  for (const auto& t : triangles) sum += glm::dot(t[0], glm::cross(t[1], t[2])) / 6;
  return sum;
}

/// For each inner scene node with drawables: the volume of its coarsest one and that of the leaves below it.
std::vector<std::pair<double, double>> inner_volumes(const Pack& pack) {
  const std::vector<SceneNode>& nodes = pack.skeleton().scene_nodes;
  std::vector<double> leaves(nodes.size(), 0);
  std::vector<std::pair<double, double>> volumes;
  for (size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
    if (nodes[i].child_count == 0) leaves[i] = volume(judge::triangles_of(pack, nodes[i].first_drawable));
    if (i > 0) leaves[nodes[i].parent] += leaves[i];
    if (nodes[i].child_count == 0 || nodes[i].drawable_count == 0) continue;
    const DrawableId coarsest = nodes[i].first_drawable + nodes[i].drawable_count - 1;
    volumes.push_back({volume(judge::triangles_of(pack, coarsest)), leaves[i]});
  }
  return volumes;
}

uint64_t finest_triangles(const Skeleton& skeleton) {
  uint64_t triangles = 0;
  for (const SceneNode& node : skeleton.scene_nodes) {
    if (node.child_count == 0) triangles += skeleton.drawables[node.first_drawable].triangles;
  }
  return triangles;
}

TEST(Instances, a_build_with_sub_hierarchies_is_sound_and_draws_what_the_flat_one_does) {
  const Model model = scenes::make("storeys");
  const BuildReport report = build(model, "storeys");
  EXPECT_EQ(report.sub_hierarchies, 2u);
  EXPECT_EQ(report.instances, 6u + 1 + 6 * 3);
  expect_sound("storeys");
  const BuildReport flat = build(flattened(model), "storeys_flat");
  EXPECT_EQ(flat.sub_hierarchies, 0u);
  EXPECT_EQ(report.source_triangles, flat.source_triangles);
  EXPECT_EQ(report.placed_triangles, flat.placed_triangles);
  const Pack pack(file_of("storeys")), other(file_of("storeys_flat"));
  EXPECT_EQ(finest_triangles(pack.skeleton()), finest_triangles(other.skeleton()));
  EXPECT_NEAR(area(pack), area(other), area(other) * 1e-5);
  EXPECT_LT(pack.skeleton().chunks.size(), other.skeleton().chunks.size() / 2);
  EXPECT_EQ(pack.skeleton().objects.initial, other.skeleton().objects.initial);
  const Box box = model_box(pack.skeleton()), flat_box = model_box(other.skeleton());
  EXPECT_LT(glm::distance(box.lo, flat_box.lo) + glm::distance(box.hi, flat_box.hi), 5);
}

TEST(Instances, a_model_without_groups_gives_the_bytes_that_its_list_of_instances_gives) {
  for (const char* name : {"instances", "room"}) {
    const Model model = scenes::make(name);
    build(model, "plain");
    build(flattened(model), "plain_flat");
    EXPECT_EQ(read_file(file_of("plain")), read_file(file_of("plain_flat")));
    EXPECT_EQ(Pack(file_of("plain")).format_version(), pack_format_version);
  }
}

TEST(Instances, hlods_around_mirrored_ones_keep_their_outsides_out) {
  BuildOptions options = small_leaves;
  options.hlod_triangles = 1'000'000;  // HLODs are their children's triangles, all of them:
  options.keep.touching = false;       // joined surfaces lose what lies on others twice
  const Model model = scenes::make("storeys");
  ASSERT_TRUE(std::any_of(model.group_instances.begin(), model.group_instances.end(), [](const auto& placed) {
    return glm::determinant(glm::dmat3(placed.transform)) < 0;
  }));
  EXPECT_GT(build(model, "mirrored", options).instances, 0u);
  const auto volumes = inner_volumes(Pack(file_of("mirrored")));
  ASSERT_FALSE(volumes.empty());
  for (const auto& [coarsest, leaves] : volumes) EXPECT_NEAR(coarsest, leaves, std::abs(leaves) * 1e-4);
  // The root's comes last.
  options.rules.mirrors_flip_winding = false;
  build(model, "mirrored", options);
  const auto [coarsest, leaves] = inner_volumes(Pack(file_of("mirrored"))).back();
  EXPECT_GT(std::abs(coarsest - leaves), std::abs(leaves) * 0.1) << "the test cannot fail";
}

TEST(Instances, the_same_model_gives_the_same_bytes) {
  build(scenes::make("storeys"), "once");
  build(scenes::make("storeys"), "again", [] {
    BuildOptions options = small_leaves;
    options.memory = uint64_t{1} << 28;
    return options;
  }());
  EXPECT_EQ(read_file(file_of("once")), read_file(file_of("again")));
}

TEST(Instances, what_shares_nothing_has_none) {
  BuildOptions baked = small_leaves, median = small_leaves;
  baked.share_instances = false;
  median.hierarchy = HierarchyKind::median_split;
  for (const BuildOptions& options : {baked, median}) {
    EXPECT_EQ(build(scenes::make("storeys"), "none", options).instances, 0u);
    build(flattened(scenes::make("storeys")), "none_flat", options);
    EXPECT_EQ(read_file(file_of("none")), read_file(file_of("none_flat")));
  }
}

/// A group of spheres, to be placed.
Model row_of_spheres() {
  Model model;
  model.materials.resize(1);
  model.meshes.push_back(awkward::sphere(8, 0.4));
  model.groups.resize(1);
  for (int i = 0; i < 6; ++i)
    model.groups[0].instances.push_back({0, awkward::translation({static_cast<double>(i), 0, 0})});
  return model;
}

TEST(Instances, placements_that_floats_cannot_bear_are_placed_one_by_one) {
  Model model = row_of_spheres();
  for (int i = 0; i < 3; ++i) model.group_instances.push_back({0, awkward::translation({0, 2.0 * i, 0})});
  Affine sheared = awkward::translation({0, 8, 0});
  sheared[1] = sheared[0] + glm::dvec3(0, 1e-6, 0);
  model.group_instances.push_back({0, sheared});
  const auto placed = place_groups(model, {});
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[1].groups.size(), 3u);
  EXPECT_EQ(placed[1].inlined.size(), 6u);
  EXPECT_EQ(placed[0].uses, 3u);
  build(model, "sheared");
  expect_sound("sheared");
  Affine lost = awkward::translation({0, 9, 0});
  lost[3].x = std::numeric_limits<double>::infinity();
  model.group_instances.push_back({0, lost});
  const BuildReport report = build(model, "lost");
  EXPECT_EQ(report.instances, 3u);
  const auto& warnings = report.import.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.starts_with("6 placements left out");
  }));
}

TEST(Instances, a_transform_that_only_composed_cannot_be_borne_is_found) {
  Model model = row_of_spheres();
  // Each stretches one axis six times: together thirty-six times, at an angle.
  Affine stretched(1), turned(1);
  turned[0] = {4, 4, 0};
  turned[1] = {-1, 1, 0};
  stretched[0].x = 8;
  model.groups[0].instances.back().transform = turned;
  for (int i = 0; i < 4; ++i) {
    Affine placed = i < 2 ? stretched : Affine(1);
    if (i == 0) placed = placed * glm::dmat4(turned) * glm::dmat4(stretched);
    placed[3] = {0, 20.0 * i, 0};
    model.group_instances.push_back({0, placed});
  }
  build(model, "composed");
  expect_sound("composed");
}

TEST(Instances, a_group_in_one_place_is_part_of_what_it_is_in) {
  Model model = row_of_spheres();
  model.groups.push_back({{}, {{0, Affine(1)}}});
  model.group_instances = {{1, awkward::translation({0, 1, 0})}, {1, awkward::translation({0, 3, 0})}};
  auto placed = place_groups(model, {});
  ASSERT_EQ(placed.size(), 2u);
  EXPECT_EQ(placed[0].inlined.size(), 6u);
  EXPECT_EQ(placed[0].uses, 2u);
  model.group_instances.pop_back();
  placed = place_groups(model, {});
  ASSERT_EQ(placed.size(), 1u);
  EXPECT_EQ(placed[0].inlined.size(), 6u);
  EXPECT_EQ(placed[0].inlined[5].transform[3], glm::dvec3(5, 1, 0));
}

TEST(Instances, stretches_and_uses_multiply_along_the_way) {
  Model model = row_of_spheres();
  const Affine twice(glm::dmat4x3(2, 0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0));
  model.groups.push_back({{{0, Affine(1)}}, {{0, Affine(1)}, {0, twice}}});
  model.group_instances = {{1, Affine(1)}, {1, twice}, {0, Affine(1)}};
  const auto placed = place_groups(model, {});
  ASSERT_EQ(placed.size(), 3u);
  EXPECT_EQ(placed[0].uses, 5u);
  EXPECT_NEAR(placed[0].stretch, 4, 1e-9);
  EXPECT_EQ(placed[1].uses, 2u);
  EXPECT_NEAR(placed[1].stretch, 2, 1e-9);
}

TEST(Instances, groups_of_which_nothing_is_left_stand_nowhere) {
  Model model = row_of_spheres();
  Mesh nothing{"nothing", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{{0, 0, 0}, 0}}};
  model.meshes.push_back(nothing);
  model.groups.push_back({{{1, Affine(1)}, {1, Affine(1)}}, {}});
  model.group_instances = {
      {0, Affine(1)}, {0, awkward::translation({0, 3, 0})}, {1, Affine(1)}, {1, Affine(1)}};
  const BuildReport report = build(model, "nothing");
  EXPECT_EQ(report.sub_hierarchies, 1u);
  EXPECT_EQ(report.instances, 2u);
  expect_sound("nothing");
}

}  // namespace
}  // namespace triptych
