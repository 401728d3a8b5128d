// --up and --unit: the model is in metres, y up, whatever the file was in.
#include "import_support.hpp"

#include <glm/vec4.hpp>

namespace triptych {
namespace {

using test::warns;
using test::write_model;

const std::string triangle = "v 1 2 3\nv 4 5 6\nv 7 8 10\nf 1 2 3\n";

glm::dvec3 first_corner(const ImportOptions& options, const std::string& name = "a.obj") {
  const Model model = import_model({write_model(name, triangle)}, options);
  return model.instances[0].transform * glm::dvec4(model.meshes[0].positions[0], 1);
}

ImportOptions options_of(std::optional<UpAxis> up, std::optional<LengthUnit> unit) {
  ImportOptions options;
  options.up = up;
  options.unit = unit;
  return options;
}

TEST(ImportUnits, without_options_a_file_is_in_metres_y_up) {
  EXPECT_EQ(first_corner({}), glm::dvec3(1, 2, 3));
  EXPECT_EQ(first_corner(options_of(UpAxis::y, LengthUnit::metre)), glm::dvec3(1, 2, 3));
}

TEST(ImportUnits, z_up_is_turned_and_not_mirrored) {
  EXPECT_EQ(first_corner(options_of(UpAxis::z, std::nullopt)), glm::dvec3(1, 3, -2));
}

TEST(ImportUnits, every_unit_comes_out_in_metres) {
  const auto scaled = [](LengthUnit unit) { return first_corner(options_of(std::nullopt, unit)).x; };
  EXPECT_EQ(scaled(LengthUnit::centimetre), 0.01);
  EXPECT_EQ(scaled(LengthUnit::millimetre), 0.001);
  EXPECT_EQ(scaled(LengthUnit::inch), 0.0254);
  EXPECT_EQ(scaled(LengthUnit::foot), 0.3048);
  EXPECT_EQ(first_corner(options_of(UpAxis::z, LengthUnit::millimetre)), glm::dvec3(0.001, 0.003, -0.002));
}

TEST(ImportUnits, coordinates_in_the_mesh_stay_as_the_file_has_them) {
  const Model model = import_model({write_model("a.obj", triangle)}, options_of(UpAxis::z, LengthUnit::inch));
  EXPECT_EQ(model.meshes[0].positions[2], glm::dvec3(7, 8, 10));
  EXPECT_FALSE(warns(model, "not applied"));
}

TEST(ImportUnits, gltf_says_metres_and_y_up_and_other_wishes_are_a_warning) {
  const std::string gltf = R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0, "translation": [1, 2, 3]}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}]})";
  const auto file = write_model("a.gltf", gltf);
  const Model wished = import_model({file}, options_of(UpAxis::z, LengthUnit::millimetre));
  EXPECT_EQ(wished.instances[0].transform[3], glm::dvec3(1, 2, 3));
  EXPECT_TRUE(warns(wished, "--up was not applied"));
  EXPECT_TRUE(warns(wished, "--unit was not applied"));
  EXPECT_TRUE(import_model({file}, options_of(UpAxis::y, LengthUnit::metre)).report.warnings.empty());
  // Beside a file that does not say, each goes its own way.
  const Model both =
      import_model({file, write_model("a.obj", triangle)}, options_of(UpAxis::z, LengthUnit::millimetre));
  EXPECT_EQ(both.instances[0].transform[0], glm::dvec3(1, 0, 0));
  EXPECT_EQ(both.instances[1].transform[1], glm::dvec3(0, 0, -0.001));
}

}  // namespace
}  // namespace triptych
