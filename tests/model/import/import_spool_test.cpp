// Text files that are too large for memory, and the cache that random positions are read through.
#include "base/memory.hpp"
#include "import_support.hpp"
#include "model/import/mesh_stream_positions.hpp"
#include "preprocess/weld.hpp"

namespace triptych {
namespace {

using test::in_memory;
using test::triangles_of;
using test::write_model;

constexpr uint32_t side = 90;  ///< vertices along a side of a square

std::string grid_obj(bool faces_first) {
  std::string vertices, faces;
  for (uint32_t i = 0; i < side * side; ++i)
    vertices += fmt::format("v {} {} {}\n", 0.1 * (i % side), i / side, 1e-9 * i);
  for (uint32_t i = 0; i < (side - 1) * (side - 1); ++i) {
    const uint32_t a = i / (side - 1) * side + i % (side - 1) + 1;
    if (i % 500 == 0) faces += fmt::format("g part {}\nusemtl {}\n", i, i % 1000 == 0 ? "red" : "blue");
    faces += i % 2 == 0 ? fmt::format("f {} {} {} {}\n", a, a + 1, a + side + 1, a + side)
                        : fmt::format("f {} {} {}\n", a, a + 1, a + side);
  }
  return "mtllib two.mtl\n" + (faces_first ? faces + vertices : vertices + faces);
}

TEST(ImportSpool, large_text_files_move_to_a_temporary_file_that_has_no_name) {
  write_model("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const auto folder = test::empty_folder("temporary");
  const ImportOptions few = {.temporary_folder = folder, .max_in_memory = 1000};
  for (const bool faces_first : {false, true}) {
    const auto file = write_model("a.obj", grid_obj(faces_first));
    const Model expected = import_model({file}, in_memory), found = import_model({file}, few);
    ASSERT_EQ(found.meshes.size(), 16u);
    for (size_t i = 0; i < found.meshes.size(); ++i) {
      ASSERT_TRUE(found.meshes[i].stream);
      EXPECT_FALSE(expected.meshes[i].stream);
      EXPECT_EQ(found.meshes[i].name, expected.meshes[i].name);
      EXPECT_EQ(found.meshes[i].triangle_count(), expected.meshes[i].triangle_count());
      EXPECT_EQ(triangles_of(found.meshes[i]), triangles_of(expected.meshes[i]));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
  }
}

TEST(ImportSpool, what_is_dropped_on_the_way_has_the_same_warning) {
  std::string text = grid_obj(false) + "v nan 0 0\nf 1 2 -1\nf";
  for (uint32_t i = 1; i < 5000; ++i) text += fmt::format(" {}", i);
  const auto file = write_model("a.obj", text + "\n");
  write_model("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const Model expected = import_model({file}, in_memory),
              found = import_model({file}, {.max_in_memory = 1000});
  ASSERT_EQ(expected.report.warnings.size(), 2u);
  std::vector<std::string> warnings = found.report.warnings;
  for (const Mesh& mesh : found.meshes) {
    ASSERT_TRUE(mesh.stream);
    mesh.stream->read([](std::span<const CornerTriangle>) {});
    for (const std::string& warning : mesh.stream->warnings()) warnings.push_back(warning);
  }
  std::vector<std::string> sorted = expected.report.warnings;
  std::sort(sorted.begin(), sorted.end());
  std::sort(warnings.begin(), warnings.end());
  EXPECT_EQ(warnings, sorted);
}

TEST(ImportSpool, meshes_beyond_what_memory_holds_wait_in_a_file_and_weld_as_they_would_have) {
  write_model("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  const auto folder = test::empty_folder("temporary");
  const auto file = write_model("a.obj", grid_obj(false));
  const uint64_t triangles = import_model({file}, in_memory).source_triangles();
  for (const uint64_t most : {2 * triangles, 2 * triangles - 1}) {
    // The file twice: of both together the most that is not left in files is counted.
    const Model expected = import_model({file, file}, {.max_in_memory = most}),
                found = import_model(
                    {file, file}, {.temporary_folder = folder, .max_in_memory = most, .held_bytes = 100'000});
    ASSERT_EQ(found.meshes.size(), expected.meshes.size());
    const std::vector<uint32_t> materials(expected.materials.size(), 0);
    const MeshColors colors{materials};
    size_t held = 0, stored = 0;
    uint64_t welded_vertices = 0;
    for (size_t i = 0; i < found.meshes.size(); ++i) {
      const Mesh &a = expected.meshes[i], &b = found.meshes[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_EQ(triangles_of(a), triangles_of(b));
      held += !b.stream;
      stored += b.stream && !a.stream;
      // On a lattice so coarse that vertices meet.
      const Lattice lattice{.origin = glm::dvec3(0), .step = 0.25};
      const Welded left = weld(a, Affine(1), lattice, colors), right = weld(b, Affine(1), lattice, colors);
      EXPECT_EQ(left.surface.points, right.surface.points);
      EXPECT_EQ(left.surface.triangles, right.surface.triangles);
      EXPECT_EQ(left.welded_vertices, right.welded_vertices);
      welded_vertices += right.welded_vertices;
    }
    EXPECT_GT(held, 0u);
    EXPECT_GT(stored, held);
    EXPECT_GT(welded_vertices, 0u);
    EXPECT_TRUE(std::filesystem::is_empty(folder));
  }
}

TEST(ImportSpool, large_ascii_ply_and_stl_files_stream_too) {
  std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 3000\nproperty double x\nproperty double y\nproperty "
      "double z\nelement face 1000\nproperty list uchar int vertex_indices\nend_header\n";
  std::string stl = "solid s\n";
  for (int i = 0; i < 3000; ++i) ply += fmt::format("{} {} {}\n", 0.1 * i, i % 3, i % 5);
  for (int i = 0; i < 1000; ++i) {
    ply += fmt::format("3 {} {} {}\n", 3 * i, 3 * i + 1, 3 * i + 2);
    stl += "facet normal 0 0 1\nouter loop\n";
    for (int k = 0; k < 3; ++k) stl += fmt::format("vertex {} {} {}\n", 0.3 * i, k, i * k);
    stl += "endloop\nendfacet\n";
  }
  stl += "endsolid s\n";
  const ImportOptions few = {.max_in_memory = 500};
  for (const auto& file : {write_model("a.ply", ply), write_model("a.stl", stl)}) {
    const Model expected = import_model({file}, in_memory), found = import_model({file}, few);
    ASSERT_TRUE(found.meshes[0].stream);
    EXPECT_EQ(found.source_triangles(), 1000u);
    EXPECT_EQ(triangles_of(found.meshes[0]), triangles_of(expected.meshes[0]));
  }
}

TEST(ImportSpool, a_folder_for_temporary_files_that_is_not_there_is_an_error) {
  const ImportOptions nowhere = {.temporary_folder = "/nonexistent/folder", .max_in_memory = 10};
  EXPECT_THROW(import_model({write_model("a.obj", grid_obj(false))}, nowhere), Error);
}

TEST(PositionCache, positions_in_any_order_are_read_in_a_cache_of_bounded_size) {
  // A sparse file of 6 GB of zeros: 500 million vertices.
  const auto file = write_model("zeros.bin", "x");
  constexpr uint64_t count = 500'000'000;
  std::filesystem::resize_file(file, count * 12);
  const PositionTable table{
      .source = std::make_shared<StreamSource>(file),
      .count = count,
      .stride = 12,
      .fields = {{{0, ScalarType::float32}, {4, ScalarType::float32}, {8, ScalarType::float32}}}};
  const uint64_t before = peak_resident_bytes();
  PositionCache::limit_all(uint64_t{8} << 20);
  PositionCache cache(table);
  uint64_t index = 12345;
  for (int i = 0; i < 40000; ++i) {
    index = (index * 6364136223846793005u + 1442695040888963407u) % count;
    ASSERT_EQ(cache.at(index), index == 0 ? cache.at(0) : glm::dvec3(0));
  }
  EXPECT_LT(peak_resident_bytes() - before, uint64_t{12} << 20);
  std::filesystem::remove(file);
}

TEST(PositionCache, positions_beyond_the_file_are_refused) {
  const auto source = std::make_shared<StreamSource>(write_model("few.bin", std::string(35, 'x')));
  const PositionTable table{
      .source = source,
      .count = 3,
      .stride = 12,
      .fields = {{{0, ScalarType::float32}, {4, ScalarType::float32}, {8, ScalarType::float32}}}};
  EXPECT_THROW(PositionCache{table}, Error);
}

}  // namespace
}  // namespace triptych
