// Which files a model was read from: who resumes a build has to know whether they changed.
#include "import_support.hpp"

#include <algorithm>

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
  // They are known without reading the models.
  const auto known = files_of_models({first, second});
  for (const auto& file : model.files) {
    EXPECT_TRUE(std::any_of(known.begin(), known.end(), [&](const auto& other) {
      return std::filesystem::equivalent(file, other);
    })) << file;
  }
}

TEST(ImportFiles, textures_are_files_of_their_model_though_they_are_not_drawn) {
  const auto first = write_model("a.gltf", R"({"images": [{"uri": "a%20wall.png"}, {"uri": "data:,"}, 7]})");
  const auto second = write_model("b.obj", "mtllib two words.mtl\n");
  write_model("two words.mtl", "newmtl red\nmap_Kd -s 1 1 1 brick.png\n");
  std::vector<std::string> names;
  for (const auto& file : files_of_models({first, second})) names.push_back(file.filename().string());
  for (const char* name : {"a.gltf", "a wall.png", "b.obj", "two words.mtl", "brick.png"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST(ImportFiles, of_damaged_models_are_those_that_can_be_made_out) {
  for (const char* text : {"", "glTF", "{", R"({"buffers": 7})", R"({"buffers": [{"uri": 7}, {"uri")",
                           R"({"buffers": {"uri": "x"}, "images": [[[]]]})"}) {
    const auto file = write_model("a.gltf", text);
    try {
      EXPECT_EQ(files_of_models({file}).front(), file);
    } catch (const Error&) {
      // The importer says the same.
    }
  }
}

TEST(ImportFiles, embedded_buffers_are_no_files) {
  const std::string data =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  const auto file = write_model("a.gltf", gltf(R"({"byteLength": 36, "uri": ")" + data + "\"}"));
  EXPECT_EQ(names(import_model({file})), (std::vector<std::string>{"a.gltf"}));
}

}  // namespace triptych
