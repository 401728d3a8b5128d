// Subtrees of a glTF scene that repeat, and models with groups.
#include "described.hpp"
#include "import_support.hpp"
#include "model/flatten.hpp"

#include <algorithm>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>

namespace triptych {
namespace {

using nlohmann::json;
using test::append;
using test::described;
using test::write_model;

/// Meshes 0 and 1 of two triangles, mesh 2 of one; the nodes are the caller's.
json document(const std::string& nodes, const std::vector<int>& roots) {
  json scene = json::parse(R"({
    "asset": {"version": "2.0"},
    "buffers": [{"byteLength": 60, "uri": "square.bin"}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
               {"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
               {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]}],
    "scene": 0})");
  scene["nodes"] = json::parse(nodes);
  scene["scenes"] = {{{"nodes", roots}}};
  return scene;
}

ImportOptions from(uint64_t placements, uint64_t triangles) {
  ImportOptions options;
  options.group_placements = placements;
  options.group_triangles = triangles;
  return options;
}

Model import_document(const json& scene, const ImportOptions& options) {
  std::string bytes;
  for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 1.f, 1.f, 0.f}) append(bytes, value);
  for (const int index : {0, 1, 2, 2, 1, 3}) append(bytes, static_cast<uint16_t>(index));
  write_model("square.bin", bytes);
  return import_model({write_model("a.gltf", scene.dump())}, options);
}

/// Where (1, 2, 3) of each placed mesh comes to lie, sorted.
std::vector<std::array<double, 4>> places(const Model& model) {
  std::vector<std::array<double, 4>> found;
  for (const Instance& instance : model.instances) {
    const glm::dvec3 at = instance.transform * glm::dvec4(1, 2, 3, 1);
    const double size = static_cast<double>(model.meshes[instance.mesh].triangle_count());
    found.push_back({at.x, at.y, at.z, size});
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Two storeys with a square and two desks each, and a loose square; all numbers are exact.
json storeys() {
  return document(R"([
    {"translation": [0, 10, 0], "children": [1, 2, 3]},
    {"mesh": 0}, {"translation": [4, 0, 0], "children": [4]}, {"translation": [8, 0, 0], "children": [5]},
    {"mesh": 1, "scale": [2, 2, 2]}, {"mesh": 1, "scale": [2, 2, 2]},
    {"translation": [0, 20, 0], "scale": [-1, 1, 1], "children": [7, 8, 9]},
    {"mesh": 0}, {"translation": [4, 0, 0], "children": [10]}, {"translation": [8, 0, 0], "children": [11]},
    {"mesh": 1, "scale": [2, 2, 2]}, {"mesh": 1, "scale": [2, 2, 2]},
    {"mesh": 0, "translation": [0, 0, 5]}])",
                  {0, 6, 12});
}

TEST(ImportGroups, equal_subtrees_become_one_group_with_several_placements) {
  const Model model = import_document(storeys(), from(3, 6));
  ASSERT_EQ(model.groups.size(), 1u);
  EXPECT_EQ(model.groups[0].instances.size(), 3u);
  EXPECT_TRUE(model.groups[0].groups.empty());
  ASSERT_EQ(model.group_instances.size(), 2u);
  EXPECT_EQ(model.group_instances[0].transform[3], glm::dvec3(0, 10, 0));
  EXPECT_EQ(model.group_instances[1].transform[0], glm::dvec3(-1, 0, 0));
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_EQ(model.placed_triangles(), 14u);
}

TEST(ImportGroups, groups_hold_groups_and_one_that_is_only_in_another_is_none) {
  const Model model = import_document(storeys(), from(1, 2));
  ASSERT_EQ(model.groups.size(), 3u);  // a square; a desk with its scale; a storey
  const Group& storey = model.groups[2];
  EXPECT_TRUE(storey.instances.empty());
  ASSERT_EQ(storey.groups.size(), 3u);
  for (const GroupInstance& instance : storey.groups) EXPECT_LT(instance.group, 2u);
  EXPECT_EQ(model.group_instances.size(), 3u);
  EXPECT_EQ(model.placed_triangles(), 14u);
  // A subtree that stands once holds nothing that repeats.
  const Model one = import_document(
      document(R"([{"children": [1]}, {"mesh": 0, "children": [2]}, {"mesh": 1}])", {0}), from(1, 1));
  EXPECT_TRUE(one.groups.empty());
  EXPECT_EQ(one.instances.size(), 2u);
}

TEST(ImportGroups, a_flattened_model_places_what_an_import_without_groups_does) {
  ImportOptions flat;
  flat.find_groups = false;
  const Model expected = import_document(storeys(), flat);
  EXPECT_TRUE(expected.groups.empty());
  EXPECT_EQ(expected.instances.size(), 7u);
  for (const uint64_t placements : {1, 2, 3}) {
    const Model found = flattened(import_document(storeys(), from(placements, 2)));
    EXPECT_TRUE(found.groups.empty() && found.group_instances.empty());
    EXPECT_EQ(places(found), places(expected));
  }
}

TEST(ImportGroups, below_the_bounds_everything_is_an_instance_as_before) {
  for (const ImportOptions& options : {ImportOptions(), from(4, 1), from(1, 7)}) {
    const Model model = import_document(storeys(), options);
    EXPECT_TRUE(model.groups.empty());
    ASSERT_EQ(model.instances.size(), 7u);
    EXPECT_EQ(model.instances[0].transform[3], glm::dvec3(0, 10, 0));
    EXPECT_EQ(model.instances[6].transform[3], glm::dvec3(0, 0, 5));
  }
}

TEST(ImportGroups, subtrees_that_differ_in_a_bit_a_mesh_or_an_order_are_not_equal) {
  const auto groups = [](auto&& change) {
    json scene = storeys();
    change(scene["nodes"]);
    return import_document(scene, from(3, 6)).groups.size();
  };
  EXPECT_EQ(groups([](json&) {}), 1u);
  EXPECT_EQ(groups([](json& nodes) { nodes[6]["translation"] = {1, 2, 3}; }), 1u);
  EXPECT_EQ(groups([](json& nodes) { nodes[8]["translation"] = {4, 0, 1e-300}; }), 0u);
  EXPECT_EQ(groups([](json& nodes) { nodes[8]["translation"] = {4, 0, -0.0}; }), 0u);
  EXPECT_EQ(groups([](json& nodes) { nodes[10]["mesh"] = 2; }), 0u);
  EXPECT_EQ(groups([](json& nodes) { nodes[6]["children"] = {8, 7, 9}; }), 0u);
  EXPECT_EQ(groups([](json& nodes) { nodes[6]["mesh"] = 2; }), 0u);
}

TEST(ImportGroups, placements_of_an_instancing_extension_count_and_are_compared) {
  const auto scene = [](int second) {
    json made =
        document(R"([{"children": [1]}, {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes":
      {"TRANSLATION": 0}}}}, {"children": [3]}, {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes":
      {"TRANSLATION": 0}}}}])",
                 {0, 2});
    made["accessors"].push_back(made["accessors"][0]);
    made["nodes"][3]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = second;
    return made;
  };
  const Model model = import_document(scene(0), from(4, 8));
  ASSERT_EQ(model.groups.size(), 1u);
  EXPECT_EQ(model.groups[0].instances.size(), 4u);
  EXPECT_EQ(model.placed_triangles(), 16u);
  EXPECT_TRUE(import_document(scene(3), from(4, 8)).groups.empty());
  EXPECT_TRUE(import_document(scene(0), from(5, 8)).groups.empty());
}

TEST(ImportGroups, what_is_dropped_in_a_group_is_counted_as_often_as_it_is_placed) {
  json scene = storeys();
  for (const int node : {4, 10}) scene["nodes"][node]["scale"] = {1e200, 1, 1};
  scene["nodes"][5]["scale"] = scene["nodes"][11]["scale"] = {2, 2, 2};
  ImportOptions flat;
  flat.find_groups = false;
  const Model expected = import_document(scene, flat), found = import_document(scene, from(3, 6));
  EXPECT_EQ(found.groups.size(), 1u);
  EXPECT_FALSE(expected.report.warnings.empty());
  EXPECT_EQ(found.report.warnings, expected.report.warnings);
  EXPECT_EQ(found.placed_triangles(), expected.placed_triangles());
}

TEST(ImportGroups, each_placement_of_a_group_has_the_names_of_its_own_nodes) {
  json scene = storeys();
  const std::vector<std::string> names = {"floor 1", "",       "desk a", "desk b", "", "",    "floor 2",
                                          "",        "desk c", "desk d", "",       "", "lawn"};
  for (size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty()) scene["nodes"][i]["name"] = names[i];
  }
  scene["nodes"][8]["extras"] = {{"price", 12.5}, {"oak", true}, {"maker", "x"}, {"list", {1, 2}}};
  scene["meshes"][1]["name"] = "desk";
  const std::vector<std::string> expected = {"lawn",
                                             "floor 1",
                                             "floor 1 > desk a",
                                             "floor 1 > desk b",
                                             "floor 2",
                                             "floor 2 > desk c {extras: maker=x oak=true price=12.5}",
                                             "floor 2 > desk d"};
  const Model grouped = import_document(scene, from(3, 6));
  ASSERT_EQ(grouped.groups.size(), 1u);
  EXPECT_EQ(described(grouped), expected);
  ImportOptions flat;
  flat.find_groups = false;
  std::vector<std::string> flat_ones = described(import_document(scene, flat)), grouped_ones = expected;
  std::sort(flat_ones.begin(), flat_ones.end()), std::sort(grouped_ones.begin(), grouped_ones.end());
  EXPECT_EQ(flat_ones, grouped_ones);
}

TEST(ImportGroups, meshes_name_nodes_that_have_none_and_files_without_names_have_no_objects) {
  EXPECT_TRUE(import_document(storeys(), from(3, 6)).source_objects.empty());
  json scene = storeys();
  scene["meshes"][1]["name"] = "desk";
  ImportOptions flat;
  flat.find_groups = false;
  const std::vector<std::string> said = described(import_document(scene, flat));
  EXPECT_EQ(std::count(said.begin(), said.end(), "desk"), 4);
  EXPECT_EQ(std::count(said.begin(), said.end(), "none"), 3);
}

}  // namespace
}  // namespace triptych
