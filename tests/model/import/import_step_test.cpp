// STEP and IGES, which triptych-import-step reads with OpenCASCADE: assemblies, names, colours, units,
// chords.
#include "placed.hpp"
#include "step_files.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace triptych {
namespace {

using test::box_of;
using test::expect_box;
using test::placed_triangles;
using test::PlacedTriangle;
using test::warns;
using test::write_model;

std::filesystem::path place_of(const std::string& name) { return write_model(name, ""); }

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

size_t count_of(const std::vector<PlacedTriangle>& triangles, const glm::vec4& color) {
  return static_cast<size_t>(std::count_if(triangles.begin(), triangles.end(), [&](const auto& triangle) {
    return glm::length(triangle.color - color) < 0.01f;
  }));
}

class StepSchema : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ImportStep, StepSchema, testing::Values("AP203", "AP214IS", "AP242DIS"),
                         [](const auto& schema) { return std::string(schema.param); });

TEST_P(StepSchema, an_assembly_shares_its_parts_and_keeps_names_and_colours) {
  const auto file = place_of("frame.stp");
  test::write_step_assembly(file, GetParam());
  const Model model = import_model({file});
  EXPECT_EQ(model.instances.size(), 5u);
  EXPECT_EQ(model.meshes.size(), 3u) << "the block, and the plate in two colours";
  std::set<std::string> names;
  for (const Mesh& mesh : model.meshes) names.insert(mesh.name);
  EXPECT_EQ(names, (std::set<std::string>{"Block", "Plate"}));
  std::set<std::string> types;
  for (const Instance& instance : model.instances) {
    ASSERT_NE(instance.object, no_id);
    const SourceObject& object = model.source_objects.objects.at(instance.object);
    EXPECT_EQ(model.source_objects.texts[object.name], model.source_objects.texts[object.type])
        << "placements have no names of their own";
    types.insert(std::string(model.source_objects.texts[object.type]));
    EXPECT_NE(object.number, 0u);
  }
  EXPECT_EQ(types, names);
  const auto triangles = placed_triangles(model);
  EXPECT_EQ(count_of(triangles, {1, 0, 0, 1}), 6u) << "three tops";
  EXPECT_EQ(count_of(triangles, {0, 0, 1, 1}), 30u);
  EXPECT_EQ(count_of(triangles, {0, 1, 0, 1}), 12u);
  EXPECT_EQ(count_of(triangles, Material().base_color), 12u);
  for (const PlacedTriangle& triangle : triangles) {
    if (glm::length(triangle.color - glm::vec4(1, 0, 0, 1)) > 0.01f) continue;
    for (const auto& corner : triangle.corners) EXPECT_NEAR(corner.y, 0.03, 1e-9);
  }
  expect_box(model, {0, 0, -0.02}, {0.405, 0.03, 0});
  EXPECT_TRUE(model.report.warnings.empty()) << model.report.warnings.front();
}

TEST(ImportStep, what_has_no_colour_has_that_of_the_assembly_it_is_placed_in) {
  const auto file = place_of("pair.stp");
  test::write_step_coloured_assembly(file);
  const Model model = import_model({file});
  std::map<std::pair<bool, bool>, glm::vec4> colors;  // by whether it is the second pair, and the second part
  for (const PlacedTriangle& triangle : placed_triangles(model)) {
    const double x = (triangle.corners[0].x + triangle.corners[1].x + triangle.corners[2].x) / 3;
    colors[{x > 0.06, std::fmod(x, 0.1) > 0.015}] = triangle.color;
  }
  EXPECT_EQ(colors.size(), 4u);
  EXPECT_EQ((colors[{false, false}]), Material().base_color);
  EXPECT_EQ((colors[{false, true}]), glm::vec4(0, 0, 1, 1));
  EXPECT_EQ((colors[{true, false}]), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ((colors[{true, true}]), glm::vec4(0, 0, 1, 1)) << "a part's own colour is kept";
}

TEST(ImportStep, the_axis_that_is_up_is_z_unless_the_user_says_another) {
  const auto file = place_of("cylinder.step");
  test::write_step_cylinder(file, "MM");
  expect_box(import_model({file}), {-0.05, 0, -0.05}, {0.05, 0.1, 0.05}, 1e-4);
  ImportOptions options;
  options.up = UpAxis::y;
  const Model model = import_model({file}, options);
  expect_box(model, {-0.05, -0.05, 0}, {0.05, 0.05, 0.1}, 1e-4);
  EXPECT_FALSE(warns(model, "--up"));
}

TEST(ImportStep, the_files_unit_is_followed_and_a_flag_that_differs_is_reported) {
  ImportOptions options;
  options.unit = LengthUnit::millimetre;
  for (const char* unit : {"MM", "INCH", "M"}) {  // OpenCASCADE writes the same size in each
    const auto file = place_of("cylinder.stp");
    test::write_step_cylinder(file, unit);
    const Model model = import_model({file}, options);
    expect_box(model, {-0.05, 0, -0.05}, {0.05, 0.1, 0.05}, 1e-4);
    EXPECT_TRUE(warns(model, "the format says its unit; --unit was not applied"));
  }
}

/// How far the middles of edges and triangles of the mantle lie within the cylinder.
double deepest(const Model& model) {
  double result = 0;
  for (const PlacedTriangle& triangle : placed_triangles(model)) {
    const auto radius = [](const glm::dvec3& point) { return std::hypot(point.x, point.z); };
    if (std::any_of(triangle.corners.begin(), triangle.corners.end(),
                    [&](const auto& corner) { return radius(corner) < 0.0499; }))
      continue;  // of a lid
    const auto& [a, b, c] = triangle.corners;
    const bool is_mantle = std::abs(glm::normalize(glm::cross(b - a, c - a)).y) < 0.5;
    if (!is_mantle) continue;
    for (const auto& middle : {(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0})
      result = std::max(result, 0.05 - radius(middle));
  }
  return result;
}

TEST(ImportStep, triangles_lie_within_the_chord_and_a_smaller_one_makes_more) {
  const auto file = place_of("cylinder.stp");
  test::write_step_cylinder(file, "MM");
  uint64_t before = 0;
  for (const double chord : {1e-3, 1e-4, 1e-5}) {
    ImportOptions options;
    options.chord = chord;
    const Model model = import_model({file}, options);
    EXPECT_LE(deepest(model), chord * 1.01) << chord;
    EXPECT_GT(model.source_triangles(), before);
    before = model.source_triangles();
  }
  EXPECT_LE(deepest(import_model({file})), 0.1 / 10'000 * 1.01) << "a ten-thousandth of 0.1 m";
}

TEST(ImportStep, an_iges_file_is_read_in_its_unit) {
  const auto file = place_of("block.igs");
  for (const char* unit : {"MM", "IN"}) {
    test::write_iges_block(file, unit);
    const Model model = import_model({file});
    EXPECT_EQ(model.placed_triangles(), 12u);
    expect_box(model, {0, 0, -0.02}, {0.01, 0.03, 0});
  }
}

TEST(ImportStep, solids_in_groups_of_iges_are_objects_by_their_names) {
  for (const char* third : {"Third", ""}) {
    const auto file = place_of("groups.igs");
    test::write_iges_groups(file, third);
    const Model model = import_model({file});
    ASSERT_EQ(model.instances.size(), 3u);
    std::map<std::string, double> middles;
    for (const Instance& instance : model.instances) {
      const Mesh& mesh = model.meshes[instance.mesh];
      EXPECT_EQ(mesh.triangle_count(), 12u);
      double sum = 0;
      for (const auto& triangle : test::triangles_of(mesh))
        sum += (instance.transform * glm::dvec4(triangle.corners[0], 1)).x / 12;
      const SourceObject& object = model.source_objects.objects.at(instance.object);
      middles[std::string(model.source_objects.texts[object.name])] = std::round(sum * 50) / 50;
      EXPECT_EQ(model.source_objects.texts[object.type], "Whole");
    }
    EXPECT_EQ(middles, (std::map<std::string, double>{
                           {"Left", 0}, {"Right", 0.02}, {*third ? third : "Whole", 0.04}}));
    const auto triangles = placed_triangles(model);
    for (const glm::vec4& color : {glm::vec4(1, 0, 0, 1), {0, 0, 1, 1}, {0, 1, 0, 1}})
      EXPECT_EQ(count_of(triangles, color), 12u);
  }
}

TEST(ImportStep, large_parts_stream_from_a_file_without_a_name) {
  const auto file = place_of("cylinder.stp");
  test::write_step_cylinder(file, "MM");
  ImportOptions options;
  options.stream_above = 0;
  options.temporary_folder = test::empty_folder("temporary");
  const Model streamed = import_model({file}, options), held = import_model({file});
  ASSERT_TRUE(streamed.meshes[0].stream);
  EXPECT_EQ(test::triangles_of(streamed.meshes[0]), test::triangles_of(held.meshes[0]));
  EXPECT_TRUE(std::filesystem::is_empty(options.temporary_folder));
}

TEST(ImportStep, a_file_without_shapes_or_of_another_kind_is_one_line) {
  for (const char* name : {"a.stp", "a.igs"}) {
    EXPECT_NE(test::import_error(name, ""), "");
    EXPECT_NE(test::import_error(name, std::string(3000, '\xff')), "");
    EXPECT_NE(test::import_error(name, "solid a\nendsolid a\n"), "");
  }
}

/// Cuts and flipped bytes at so many places: an Error or a model, never anything else.
void expect_some_damage_is_survived(const std::string& name, const std::string& contents, size_t places) {
  for (size_t i = 0; i < places; ++i) {
    const size_t at = contents.size() * i / places + i % 7;
    std::string flipped = contents;
    flipped[at] = static_cast<char>(flipped[at] ^ (1 << (i % 8)));
    test::import_error(name, flipped);
    test::import_error(name, contents.substr(0, at));
  }
}

TEST(ImportStep, damaged_files_are_one_line_or_what_is_left_of_them) {
  const auto step = place_of("frame.stp"), iges = place_of("block.igs");
  test::write_step_assembly(step, "AP214IS");
  expect_some_damage_is_survived("damaged.stp", contents_of(step), 25);
  test::write_iges_block(iges, "MM");
  expect_some_damage_is_survived("damaged.igs", contents_of(iges), 25);
}

}  // namespace
}  // namespace triptych
