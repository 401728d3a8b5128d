// Which files a model was read from: who resumes a build has to know whether they changed.
#include "import_support.hpp"

namespace triptych {
namespace {

using test::write_model;

std::vector<std::string> names(const Model& model) {
  std::vector<std::string> names;
  for (const auto& file : model.files) names.push_back(file.filename().string());
  return names;
}

constexpr const char* document = R"({
    "asset": {"version": "2.0"},
    "buffers": [BUFFER],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0})";

std::string gltf(const std::string& buffer) {
  std::string text = document;
  return text.replace(text.find("BUFFER"), 6, buffer);
}

}  // namespace

TEST(ImportFiles, are_the_models_the_buffers_and_the_material_libraries_that_they_name) {
  std::string corners(36, '\0');
  for (const size_t axis : {3u, 7u}) {
    const float one = 1;
    std::memcpy(corners.data() + 4 * axis, &one, sizeof(one));
  }
  write_model("corners.bin", corners);
  write_model("paint.mtl", "newmtl red\nKd 1 0 0\n");
  const auto first = write_model("a.gltf", gltf(R"({"byteLength": 36, "uri": "corners.bin"})"));
  const auto second = write_model("b.obj", "mtllib paint.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Model model = import_model({first, second});
  EXPECT_EQ(names(model), (std::vector<std::string>{"a.gltf", "corners.bin", "b.obj", "paint.mtl"}));
  for (const auto& file : model.files) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(ImportFiles, embedded_buffers_are_no_files) {
  const std::string data =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const auto file = write_model("a.gltf", gltf(R"({"byteLength": 36, "uri": ")" + data + "\"}"));
  EXPECT_EQ(names(import_model({file})), (std::vector<std::string>{"a.gltf"}));
}

}  // namespace triptych
