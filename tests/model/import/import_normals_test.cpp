// Shading normals of PLY and OBJ: the same from memory, from a stream, and from the file in place.
#include "model/read_mesh.hpp"
#include "tests/model/import/import_support.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace triptych {
namespace {

using test::import_text;
using test::warns;

std::vector<CornerNormals> normals_of(const Mesh& mesh) {
  std::vector<CornerNormals> all;
  read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) all.push_back(triangle.normals);
  });
  return all;
}

VertexNormal towards(double x, double y, double z) { return to_vertex_normal({x, y, z}); }

TEST(ImportNormals, of_an_obj_belong_to_corners_wherever_the_mesh_is_kept) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\nvn 1 0 1\nvt 0 0\n"
      "f 1//1 2//2 3//1\nf 1/1/-2 3/1/2 4/1/1\nf 1 3 4\nf 1//1 3//9 4//x\n";
  const VertexNormal up = towards(0, 0, 1), aside = towards(1, 0, 1);
  const std::vector<CornerNormals> wanted = {{up, aside, up}, {up, aside, up}, {}, {up, {}, {}}};
  for (const uint64_t in_memory : {uint64_t{1} << 20, uint64_t{0}}) {
    const Model model = import_text("a.obj", text, {.max_in_memory = in_memory});
    EXPECT_EQ(model.meshes.at(0).stream != nullptr, in_memory == 0);
    EXPECT_TRUE(model.meshes.at(0).has_normals());
    EXPECT_EQ(normals_of(model.meshes.at(0)), wanted);
  }
  EXPECT_FALSE(import_text("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").meshes.at(0).has_normals());
}

TEST(ImportNormals, of_an_obj_that_come_behind_faces_are_said) {
  const Model model =
      import_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  EXPECT_TRUE(warns(model, "normals behind the first faces"));
  EXPECT_FALSE(model.meshes.at(0).has_normals());
}

TEST(ImportNormals, of_a_ply_are_those_of_its_vertices_in_text_and_in_both_byte_orders) {
  const std::string header =
      " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
      "property float ny\nproperty float nz\nelement face 1\nproperty list uint8 uint32 "
      "vertex_index\nend_header\n";
  const std::vector<std::array<float, 6>> vertices = {
      {0, 0, 0, 0, 0, 1}, {1, 0, 0, 3, 0, 3}, {0, 1, 0, 0, -1, 0}};
  const std::vector<CornerNormals> wanted = {{towards(0, 0, 1), towards(1, 0, 1), towards(0, -1, 0)}};
  std::string text = "ply\nformat ascii" + header;
  for (const auto& vertex : vertices) {
    for (const float value : vertex) text += std::to_string(value) + " ";
    text += "\n";
  }
  text += "3 0 1 2\n";
  for (const uint64_t in_memory : {uint64_t{1} << 20, uint64_t{0}}) {
    const Model model = import_text("a.ply", text, {.max_in_memory = in_memory});
    EXPECT_EQ(model.meshes.at(0).stream != nullptr, in_memory == 0);
    EXPECT_EQ(normals_of(model.meshes.at(0)), wanted);
    EXPECT_TRUE(model.report.warnings.empty());
  }
  for (const bool big : {false, true}) {
    std::string bytes = std::string("ply\nformat binary_") + (big ? "big" : "little") + "_endian" + header;
    const auto append = [&](auto value) {
      std::array<char, sizeof(value)> raw;
      std::memcpy(raw.data(), &value, sizeof(value));
      if (big) std::reverse(raw.begin(), raw.end());
      bytes.append(raw.data(), raw.size());
    };
    for (const auto& vertex : vertices) {
      for (const float value : vertex) append(value);
    }
    append(uint8_t{3});
    for (const uint32_t corner : {0u, 1u, 2u}) append(corner);
    for (const uint64_t above : {uint64_t{1000}, uint64_t{0}}) {
      const Model model = import_text("a.ply", bytes, {.stream_above = above});
      EXPECT_EQ(normals_of(model.meshes.at(0)), wanted) << (big ? "big" : "little") << above;
    }
  }
}

}  // namespace
}  // namespace triptych
