// Models in .gz and .zip.
#include "zip_support.hpp"

#include <zlib.h>

namespace triptych {
namespace {

using test::write_model;
using test::write_zip;

std::string gzip(const std::string& text) {
  const auto file = write_model("packed", "");
  const gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  return test::bytes_of(file);
}

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ImportPacked, a_gzipped_file_is_read_as_what_is_in_it) {
  write_model("red.mtl", "newmtl red\nKd 1 0 0\n");
  const std::string text = "mtllib red.mtl\n" + square + "usemtl red\nf 1 2 3 4\n";
  const Model model = test::import_text("a.obj.gz", gzip(text));
  EXPECT_EQ(model.source_triangles(), 2u);
  EXPECT_EQ(model.materials[model.meshes[0].triangles[0].material].base_color, glm::vec4(1, 0, 0, 1));
  // Several members are one text; what stands behind the last one is padding.
  EXPECT_EQ(test::import_text("b.OBJ.GZ", gzip(square) + gzip("f 1 2 3 4\n") + std::string(512, '\0'))
                .source_triangles(),
            2u);
}

TEST(ImportPacked, damaged_gzip_is_one_line) {
  const std::string whole = gzip(square + "f 1 2 3 4\n");
  EXPECT_NE(test::import_error("a.obj.gz", whole.substr(0, whole.size() - 12)).find("gzip data end too soon"),
            std::string::npos);
  std::string damaged = whole;
  damaged[whole.size() / 2] ^= 0x55;
  EXPECT_NE(test::import_error("a.obj.gz", damaged), "");
  EXPECT_NE(test::import_error("a.gz", whole).find("not known by its name"), std::string::npos);
  test::expect_robust("a.obj.gz", whole);
}

TEST(ImportPacked, the_model_of_an_archive_is_read_with_the_files_beside_it) {
  const auto file =
      write_zip("a.zip", {{"house/readme.txt", "hello"},
                          {"__MACOSX/house/._a.obj", "x"},
                          {"house/colours/Red.mtl", "newmtl red\nKd 1 0 0\n"},
                          {"house/a.obj", "mtllib colours\\red.mtl\n" + square + "usemtl red\nf 1 2 3 4\n"}});
  const Model model = import_model({file});
  EXPECT_EQ(model.materials[model.meshes[0].triangles[0].material].base_color, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(files_of_models({file}), std::vector{file});
}

TEST(ImportPacked, archives_without_a_model_or_with_several_are_refused) {
  const auto error_of = [](const std::filesystem::path& file) {
    try {
      import_model({file});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(error_of(write_zip("a.zip", {{"readme.txt", "x"}})).find("holds no model"), std::string::npos);
  EXPECT_NE(
      error_of(write_zip("b.zip", {{"a.obj", square}, {"b.stl", "x"}})).find("holds 2 models (a.obj, b.stl"),
      std::string::npos);
  test::expect_robust("c.zip", test::bytes_of(write_zip("whole.zip", {{"a.obj", square + "f 1 2 3\n"}})));
}

TEST(ImportPacked, large_content_goes_to_a_temporary_file_and_streams_from_there) {
  std::string text = square;
  while (text.size() < size_t{33} << 20) text += "# " + std::string(100000, 'x') + "\n";
  ImportOptions options;
  options.temporary_folder = test::empty_folder("temporary");
  EXPECT_EQ(import_model({write_model("a.obj.gz", gzip(text + "f 1 2 3\n"))}, options).source_triangles(),
            1u);
  EXPECT_TRUE(std::filesystem::is_empty(options.temporary_folder));
}

}  // namespace
}  // namespace triptych
