// The stream between a reader's process and the importer: what is written is read, and damage is an error.
#include "base/descriptor.hpp"
#include "described.hpp"
#include "model/import/import_file.hpp"
#include "model/import/scene_writer.hpp"
#include "placed.hpp"

#include <fcntl.h>
#include <filesystem>
#include <limits>

namespace triptych {
namespace {

using test::described;
using test::expect_box;
using test::warns;
using test::write_model;

const std::vector<glm::dvec3> corners = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, {0, 0, 1}};
const std::vector<uint32_t> two_triangles = {0, 1, 2, 0, 2, 3};

/// The bytes that these calls write.
std::vector<std::byte> written(const std::function<void(SceneWriter&)>& write, uint32_t defined = 3) {
  const auto file = write_model("written", "");
  const Descriptor descriptor(::open(file.c_str(), O_RDWR));
  SceneWriter writer(descriptor.number(), "a test", defined);
  write(writer);
  std::vector<std::byte> bytes(size_of(descriptor.number(), "a test"));
  read_at(descriptor.number(), 0, bytes, "a test");
  return bytes;
}

Model imported(std::vector<std::byte> bytes, const ImportOptions& options = {}) {
  Model model;
  model.materials.emplace_back();
  FileImport target("a.ifc", model, options);
  import_scene(target, std::make_shared<StreamSource>("a.ifc", std::move(bytes)));
  target.finish();
  return model;
}

std::vector<std::byte> small_scene() {
  return written([](SceneWriter& writer) {
    const uint32_t red = writer.material({1, 0, 0, 1}), half = writer.material({0, 0.5f, 0, 1});
    const std::vector<ScenePart> parts = {{1, no_record}, {1, half}};
    const uint32_t mesh = writer.mesh("Wall", corners, two_triangles, parts);
    const uint32_t set = writer.property_set({"Set", {{"Name", "Value"}, {"Other", ""}}});
    const uint32_t object = writer.object({"#1", "Wall", "guid", "IfcWall", "Storey", "Layer", {set}});
    writer.instance({mesh, red, object, Affine(1)});
    writer.instance({mesh, no_record, no_record, Affine(2)});
    writer.end();
  });
}

TEST(SceneStream, faces_without_a_material_inherit_the_instances) {
  const Model model = imported(small_scene());
  EXPECT_EQ(model.meshes.size(), 2u);
  EXPECT_EQ(model.meshes[0].name, "Wall");
  const auto triangles = test::placed_triangles(model);
  ASSERT_EQ(triangles.size(), 4u);
  EXPECT_EQ(triangles[0].color, glm::vec4(1, 0, 0, 1));
  EXPECT_NEAR(triangles[1].color.g, 0.2140, 1e-3);
  EXPECT_EQ(triangles[2].color, Material().base_color);
  expect_box(model, {0, 0, 0}, {8, 4, 2});
}

TEST(SceneStream, meshes_that_stay_in_the_stream_give_the_same_triangles) {
  ImportOptions options;
  options.stream_above = 0;
  const Model streamed = imported(small_scene(), options), held = imported(small_scene());
  ASSERT_EQ(streamed.meshes.size(), held.meshes.size());
  for (size_t i = 0; i < held.meshes.size(); ++i) {
    ASSERT_TRUE(streamed.meshes[i].stream);
    EXPECT_EQ(test::triangles_of(streamed.meshes[i]), test::triangles_of(held.meshes[i]));
  }
}

TEST(SceneStream, axes_and_units_that_a_file_leaves_open_are_the_users) {
  const auto open = written(
      [](SceneWriter& writer) {
        const std::vector<ScenePart> parts = {{2, no_record}};
        writer.instance({writer.mesh("", corners, two_triangles, parts), no_record, no_record, Affine(1)});
        writer.end();
      },
      0);
  const Model assumed = imported(open);
  expect_box(assumed, {0, 0, -2}, {4, 1, 0});
  EXPECT_TRUE(warns(assumed, "names no unit of length"));
  ImportOptions options;
  options.up = UpAxis::y;
  options.unit = LengthUnit::centimetre;
  expect_box(imported(open, options), {0, 0, 0}, {0.04, 0.02, 0.01});
}

TEST(SceneStream, a_placement_that_is_not_finite_is_left_out_and_counted) {
  const Model model = imported(written([](SceneWriter& writer) {
    const std::vector<ScenePart> parts = {{2, no_record}};
    SceneInstance instance{writer.mesh("", corners, two_triangles, parts), no_record, no_record, Affine(1)};
    writer.instance(instance);
    instance.transform[3].x = std::numeric_limits<double>::quiet_NaN();
    writer.instance(instance);
    writer.end();
  }));
  EXPECT_EQ(model.instances.size(), 1u);
  EXPECT_TRUE(warns(model, "1 placements were left out: their coordinates are not finite"));
}

TEST(SceneStream, every_cut_is_an_error_and_no_flipped_byte_does_harm) {
  const std::vector<std::byte> whole = small_scene();
  for (size_t size = 0; size < whole.size(); ++size) {
    const std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(imported(cut), Error) << size;
  }
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const int bit : {0, 3, 7}) {
      std::vector<std::byte> flipped = whole;
      flipped[i] ^= static_cast<std::byte>(1 << bit);
      try {
        test::placed_triangles(imported(flipped));
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("a.ifc"), 0u) << error.what();
      }
    }
  }
}

TEST(SceneStream, instances_keep_their_objects_with_all_that_is_said_of_them) {
  const Model model = imported(small_scene());
  EXPECT_EQ(
      described(model),
      (std::vector<std::string>{
          "Wall (IfcWall) guid guid layer Layer storey Storey number #1 {Set: Name=Value Other=}", "none"}));
}

}  // namespace
}  // namespace triptych
