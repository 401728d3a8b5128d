// Reading catalogues: properties, OBJ and MTL texts, texture colours, the package's archives.
#include "base/error.hpp"
#include "samples/building/furniture_catalog.hpp"
#include "samples/building/image_average.hpp"
#include "samples/building/obj_furniture.hpp"
#include "samples/building/obj_text.hpp"
#include "samples/building/properties.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

namespace triptych {
namespace {

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Properties, keys_end_at_equals_colon_or_blank_and_values_keep_their_inner_blanks) {
  const auto entries = parse_properties("a = one two \nb:2\nc 3\n  d=\n", "p");
  EXPECT_EQ(entries.at("a"), "one two ");
  EXPECT_EQ(entries.at("b"), "2");
  EXPECT_EQ(entries.at("c"), "3");
  EXPECT_EQ(entries.at("d"), "");
}

TEST(Properties, latin_1_and_unicode_escapes_become_utf_8) {
  const auto entries = parse_properties("a=H\xf4i\nb=10\\u20ac\nc=\\ud83d\\ude00\nd=\\u00e9\\t\\\\", "p");
  EXPECT_EQ(entries.at("a"), "H\xc3\xb4i");
  EXPECT_EQ(entries.at("b"), "10\xe2\x82\xac");
  EXPECT_EQ(entries.at("c"), "\xf0\x9f\x98\x80");
  EXPECT_EQ(entries.at("d"), "\xc3\xa9\t\\");
}

TEST(Properties, comments_are_skipped_and_lines_that_end_in_a_backslash_go_on) {
  const auto entries = parse_properties("# a=1\n! b=2\r\nc=one \\\r\n   two\n\nname\\ with\\=signs=3", "p");
  EXPECT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries.at("c"), "one two");
  EXPECT_EQ(entries.at("name with=signs"), "3");
}

TEST(Properties, a_broken_escape_is_an_error_with_its_line) {
  EXPECT_THAT(message_of([] { parse_properties("a=1\nb=\\u12", "p"); }), testing::HasSubstr("p: line 2"));
}

TEST(Obj, negative_indices_count_back_from_the_last_vertex) {
  const auto model = parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf 1//2 2/1/1 -1", "o");
  ASSERT_EQ(model.polygons.size(), 1u);
  EXPECT_THAT(model.polygons[0].corners, testing::ElementsAre(0, 1, 2, 0, 1, 3));
}

TEST(Obj, faces_are_kept_by_material_also_without_one) {
  const auto model = parse_obj(
      "mtllib my file.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl a b\nf 1 2 3\nusemtl c\nf 1 2 3\n",
      "o");
  EXPECT_THAT(model.materials, testing::ElementsAre("", "a b", "c"));
  EXPECT_THAT(model.material_libraries, testing::ElementsAre("my file.mtl"));
}

TEST(Obj, an_index_that_is_out_of_range_is_an_error_with_its_line) {
  EXPECT_THAT(message_of([] { parse_obj("v 0 0 0\nf 1 1 2\n", "o"); }), testing::HasSubstr("o: line 2"));
  EXPECT_THAT(message_of([] { parse_obj("v 0 0 0\nf 0 1 1\n", "o"); }), testing::HasSubstr("line 2"));
  EXPECT_THAT(message_of([] { parse_obj("v 0 zero 0\n", "o"); }),
              testing::HasSubstr("'zero' is not a number"));
}

TEST(Mtl, colour_opacity_and_texture_belong_to_the_material_before_them) {
  const auto materials =
      parse_mtl("newmtl a\nKd 0.1 0.2 0.3\n\tmap_Kd my wood.jpg\r\nnewmtl b\nd 0.5\n", "m");
  EXPECT_EQ(materials.at("a").diffuse, glm::dvec3(0.1, 0.2, 0.3));
  EXPECT_EQ(materials.at("a").texture, "my wood.jpg");
  EXPECT_EQ(materials.at("b").opacity, 0.5);
}

std::string png_of(const std::vector<uint8_t>& pixels, uint32_t width, uint32_t format) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.format = format;
  image.width = width;
  image.height = static_cast<uint32_t>(pixels.size() / PNG_IMAGE_SAMPLE_CHANNELS(format) / width);
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
  return bytes;
}

TEST(ImageAverage, pixels_count_in_linear_light_and_by_their_alpha) {
  const auto grey = average_colour(png_of({0, 0, 0, 255, 255, 255}, 2, PNG_FORMAT_RGB));
  ASSERT_TRUE(grey);
  EXPECT_NEAR(grey->x, 0.5, 1e-6);
  const auto red = average_colour(png_of({255, 0, 0, 255, 0, 255, 0, 0}, 1, PNG_FORMAT_RGBA));
  ASSERT_TRUE(red);
  EXPECT_NEAR(glm::distance(*red, glm::dvec3(1, 0, 0)), 0, 1e-6);
}

TEST(ImageAverage, every_texture_that_an_archive_holds_can_be_averaged) {
  const Furniture furniture = load_furniture();
  int textured = 0;
  for (const FurniturePiece& piece : furniture.pieces) {
    if (piece.model_bytes > 60'000) continue;
    const ZipArchive& archive = *furniture.catalogues[piece.catalogue].archive;
    const std::string folder = piece.model.substr(0, piece.model.rfind('/') + 1);
    const std::string library = piece.model.substr(0, piece.model.rfind('.')) + ".mtl";
    if (!archive.contains(library)) continue;
    for (const auto& [name, material] : parse_mtl(archive.read(library), library)) {
      if (material.texture.empty() || !archive.contains(folder + material.texture)) continue;
      EXPECT_TRUE(average_colour(archive.read(folder + material.texture))) << folder << material.texture;
      ++textured;
    }
  }
  EXPECT_GT(textured, 10);
}

TEST(ImageAverage, bytes_that_are_no_image_have_no_colour) {
  EXPECT_FALSE(average_colour("GIF89a"));
  EXPECT_FALSE(average_colour("\xff\xd8\xff\xe0 cut short"));
  EXPECT_FALSE(average_colour(std::string_view("\x89PNG\r\n\x1a\n", 8)));
}

TEST(Furniture, without_catalogues_the_error_names_the_package) {
  EXPECT_THAT(message_of([] { load_furniture("/nonexistent"); }),
              testing::HasSubstr("sweethome3d-furniture"));
}

TEST(Furniture, a_model_has_the_catalogue_s_size_and_stands_on_the_ground) {
  const Furniture furniture = load_furniture();
  ASSERT_EQ(furniture.catalogues.size(), 5u);
  EXPECT_EQ(furniture.pieces.size() + furniture.without_model, 820u);
  int checked = 0;
  for (const FurniturePiece& piece : furniture.pieces) {
    const bool turned = piece.rotation != std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (!turned || piece.model_bytes > 400'000) continue;
    const auto mesh = read_furniture(piece, *furniture.catalogues[piece.catalogue].archive);
    glm::vec3 low(1e9f), high(-1e9f);
    for (const MeshPart& part : mesh.parts) {
      for (const glm::vec3& position : part.positions)
        low = glm::min(low, position), high = glm::max(high, position);
      for (const uint32_t index : part.indices) ASSERT_LT(index, part.positions.size());
    }
    const glm::vec3 size(piece.size);
    EXPECT_LT(glm::distance(low, glm::vec3(-size.x / 2, 0, -size.z / 2)), 1e-4f) << piece.id;
    EXPECT_LT(glm::distance(high, glm::vec3(size.x / 2, size.y, size.z / 2)), 1e-4f) << piece.id;
    ++checked;
  }
  EXPECT_GT(checked, 5);
}

}  // namespace
}  // namespace triptych
