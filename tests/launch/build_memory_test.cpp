// `build --memory`: what the process takes of the machine, as the system counts it.
#include "tests/session/program.hpp"

#include <array>
#include <cmath>
#include <fmt/core.h>
#include <span>

namespace triptych {
namespace {

using test::Folder;
using test::Program;

constexpr uint64_t mebibyte = uint64_t{1} << 20;

class BuildMemory : public testing::Test {
 protected:
  void SetUp() override {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers take several times as much";
#endif
  }

  /// Builds, in the least memory that there is to ask for. Returns the most that it took.
  uint64_t peak_of(const std::string& model, const std::string& memory = "128M") {
    Program build({"build", model, "-o", folder.file("a" + memory + ".tpk"), "--memory", memory, "--json",
                   folder.file("build.json")});
    EXPECT_EQ(build.wait(), 0) << build.errors();
    warned = build.errors().find("more than --memory's 128") != std::string::npos;
    return build.peak_bytes();
  }

  Folder folder;
  bool warned = false;
};

void write(std::ofstream& out, const auto& values) {
  const auto bytes = std::as_bytes(std::span(values));
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Wavy sheets one above the other, each a mesh of triangles with three vertices of their own.
std::string write_soups(const Folder& folder, int sheets, int cells) {
  std::ofstream bytes(folder.file("soups.bin"), std::ios::binary);
  std::vector<std::array<float, 3>> corners;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      for (const auto& [dx, dy] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
        const float u = static_cast<float>(x + dx), v = static_cast<float>(y + dy);
        corners.push_back({u, v, std::sin(0.3f * u) * std::cos(0.2f * v)});
      }
    }
  }
  write(bytes, corners);
  std::string meshes, nodes, roots;
  for (int i = 0; i < sheets; ++i) {
    const char* comma = i == 0 ? "" : ",";
    meshes += fmt::format(R"({}{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}})", comma);
    nodes += fmt::format(R"({}{{"mesh": {}, "translation": [0, 0, {}]}})", comma, i, 3 * i);
    roots += fmt::format("{}{}", comma, i);
  }
  const size_t size = corners.size() * sizeof(corners[0]);
  std::ofstream(folder.file("soups.gltf")) << fmt::format(
      R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [{}]}}], "nodes": [{}],
          "meshes": [{}], "buffers": [{{"uri": "soups.bin", "byteLength": {}}}],
          "bufferViews": [{{"buffer": 0, "byteLength": {}}}],
          "accessors": [{{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": {},
                          "min": [0, 0, -1], "max": [{}, {}, 1]}}]}})",
      roots, nodes, meshes, size, size, corners.size(), cells, cells);
  return folder.file("soups.gltf");
}

/// A wavy sheet of 2 × cells × cells triangles, as text.
std::string write_obj(const Folder& folder, int cells) {
  std::ofstream out(folder.file("sheet.obj"));
  const int row = cells + 1;
  for (int y = 0; y < row; ++y) {
    for (int x = 0; x < row; ++x)
      out << fmt::format("v {} {} {:.4f}\n", x, y, std::sin(0.3 * x) * std::cos(0.2 * y));
  }
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      const int a = 1 + y * row + x, b = a + 1, c = a + row, d = c + 1;
      out << fmt::format("f {} {} {}\nf {} {} {}\n", a, b, d, a, d, c);
    }
  }
  return folder.file("sheet.obj");
}

}  // namespace

TEST_F(BuildMemory, a_million_triangles_of_a_text_file_do_not_wait_in_memory) {
  // It took 130 MiB when they did.
  EXPECT_LT(peak_of(write_obj(folder, 720)), 84 * mebibyte);
  EXPECT_FALSE(warned);
}

TEST_F(BuildMemory,
       two_million_triangles_in_one_mesh_are_built_in_far_less_than_the_least_that_may_be_given) {
  test::run({"sample", "isosurface", "--triangles", "2000000", "-o", folder.file("model")});
  const uint64_t peak = peak_of(folder.file("model/scene.ply"));
  // It does not grow with the model, but for what is known about it: see docs/build.md.
  EXPECT_LT(peak, 84 * mebibyte);
  EXPECT_GT(peak, 16 * mebibyte);
  EXPECT_FALSE(warned);
  const uint64_t reported = test::json_of(folder.file("build.json"))["peak_rss_bytes"].get<uint64_t>();
  EXPECT_LE(reported, peak);
  EXPECT_GT(reported, peak - 4 * mebibyte);
}

TEST_F(BuildMemory, a_million_triangles_in_small_meshes_do_not_wait_in_memory) {
  // 120 MiB of positions and triangles.
  const std::string model = write_soups(folder, 375, 42);
  const uint64_t peak = peak_of(model);
  EXPECT_LT(peak, 96 * mebibyte);
  EXPECT_FALSE(warned);
  // Nor does what they come to depend on where they waited.
  peak_of(model, "1G");
  EXPECT_EQ(test::text_of(folder.file("a128M.tpk")), test::text_of(folder.file("a1G.tpk")));
}

TEST_F(BuildMemory, a_build_that_took_more_than_it_was_given_says_so) {
  // A model file whose text alone is larger: JSON is held as a whole.
  std::ofstream out(folder.file("a.gltf"));
  out << R"({"asset": {"version": "2.0", "extras": ")" << std::string(100 * mebibyte, 'x') << R"("},
             "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
             "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
      << "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
      << R"("}],
             "bufferViews": [{"buffer": 0, "byteLength": 36}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3,
                            "min": [0, 0, 0], "max": [1, 1, 0]}]})";
  out.close();
  EXPECT_GT(peak_of(folder.file("a.gltf")), 128 * mebibyte);
  EXPECT_TRUE(warned);
}

}  // namespace triptych
