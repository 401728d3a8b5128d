// Textures of OBJ: what libraries say of them, where images are, and what coordinates become.
#include "model/import/obj_library.hpp"
#include "model/read_mesh.hpp"
#include "tests/model/import/import_support.hpp"

#include <algorithm>

namespace triptych {
namespace {

using test::import_text;
using test::warns;
using test::write_model;

const std::string square =
    "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 2\n"
    "usemtl oak\nf 1/1 2/2 3/3 4/-1\nusemtl plain\nf 1/1 2/2 3/3\n";

Model import_square(const std::string& library, const ImportOptions& options = {}) {
  write_model("a.mtl", library);
  return import_text("a.obj", square, options);
}

std::vector<CornerCoordinates> places_of(const Mesh& mesh) {
  std::vector<CornerCoordinates> all;
  read_mesh(mesh, [&](std::span<const CornerTriangle> batch) {
    for (const CornerTriangle& triangle : batch) all.push_back(triangle.coordinates);
  });
  return all;
}

const Material& material_of(const Model& model) {
  return model.materials.at(model.meshes.at(0).triangles.at(0).material);
}

TEST(ImportObjTextures, come_with_coordinates_from_the_upper_corner_wherever_the_mesh_is_kept) {
  write_model("oak.png", "12345");
  const TextureCoordinates a = texture_coordinates(0, 1), b = texture_coordinates(1, 1),
                           c = texture_coordinates(1, 0), d = texture_coordinates(0, -1);
  for (const uint64_t in_memory : {uint64_t{1} << 20, uint64_t{0}}) {
    const Model model = import_square("newmtl oak\nKd 1 1 1\nmap_Kd oak.png\nnewmtl plain\nKd 1 0 0\n",
                                      {.max_in_memory = in_memory});
    EXPECT_TRUE(model.report.warnings.empty()) << model.report.warnings.at(0);
    EXPECT_EQ(model.meshes.at(0).stream != nullptr, in_memory == 0);
    EXPECT_TRUE(model.meshes.at(0).has_coordinates());
    const auto places = places_of(model.meshes.at(0));
    ASSERT_EQ(places.size(), 3u);
    for (const TextureCoordinates& corner : {a, b, c, d}) {
      const auto has = [&](const CornerCoordinates& triangle) {
        return std::ranges::count(triangle, corner) > 0;
      };
      EXPECT_TRUE(has(places[0]) || has(places[1])) << corner.u << " " << corner.v;
    }
    EXPECT_EQ(places[2], CornerCoordinates()) << "its material has no texture";
    ASSERT_EQ(model.images.size(), 1u);
    EXPECT_EQ(model.images[0].read().size(), 5u);
    EXPECT_EQ(model.files.back().filename(), "oak.png") << "it is a file of the model";
  }
}

TEST(ImportObjTextures, of_other_systems_are_found_by_names_with_blanks_and_backslashes) {
  write_model("oak wood.png", "12345");
  for (const char* name : {"oak wood.png", "\"oak wood.png\"", "C:\\maps\\Oak Wood.png", "maps/oak wood.png",
                           "-blendu on -bm 0.5 oak wood.png", "oak wood.png  # of the floor"}) {
    const Model model = import_square(std::string("newmtl oak\nmap_Kd ") + name + "\n");
    ASSERT_EQ(model.images.size(), 1u) << name;
    EXPECT_EQ(material_of(model).texture, 0u) << name;
    EXPECT_EQ(material_of(model).base_color, glm::vec4(1)) << "no Kd dims it";
  }
}

TEST(ImportObjTextures, one_that_is_missing_is_said_with_its_line_and_the_material_is_drawn_without) {
  const Model model = import_square("newmtl oak\nKd 1 0 0\n\nmap_Kd gone.png\n");
  EXPECT_TRUE(warns(model, "1 images are missing, and what they are on is drawn without, the first: "));
  EXPECT_TRUE(warns(model, "a.mtl: line 4 names gone.png"));
  EXPECT_EQ(material_of(model).texture, no_id);
  EXPECT_EQ(material_of(model).base_color, glm::vec4(1, 0, 0, 1));
}

TEST(ImportObjTextures, options_move_and_clamp_them_and_others_are_said_once_with_the_first_line) {
  write_model("oak.png", "1");
  const Model model = import_square(
      "newmtl oak\nmap_Kd -s 2 4 1 -o 0.5 0.25 -clamp on oak.png\nnewmtl b\nmap_Kd -mm 0 2 oak.png\n"
      "newmtl c\nmap_Kd -imfchan r oak.png\n");
  EXPECT_TRUE(warns(model, "2 options of textures are not drawn, the first, -mm, in "));
  EXPECT_TRUE(warns(model, "a.mtl: line 4"));
  EXPECT_EQ(material_of(model).sampler.wrap_u, TextureWrap::clamp);
  const auto places = places_of(model.meshes.at(0));
  EXPECT_GT(std::ranges::count(places[0], texture_coordinates(0.5, 0.75)), 0) << "the corner at 0 0";
  EXPECT_GT(std::ranges::count(places[0], texture_coordinates(2.5, -3.25)) +
                std::ranges::count(places[1], texture_coordinates(2.5, -3.25)),
            0)
      << "the corner at 1 1";
  EXPECT_EQ(model.images.size(), 1u) << "materials share it";
}

TEST(ImportObjTextures, what_is_cut_out_takes_its_alpha_from_another_image_or_from_the_same) {
  write_model("leaf.png", "123");
  write_model("mask.png", "4567");
  Model model = import_square("newmtl oak\nmap_Kd leaf.png\nmap_d mask.png\n");
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].read().size(), 3u);
  EXPECT_EQ(model.images[0].alpha->read().size(), 4u);
  EXPECT_EQ(material_of(model).cutoff, 0.5f);
  model = import_square("newmtl oak\nmap_Kd leaf.png\nmap_d leaf.png\n");
  EXPECT_EQ(model.images.at(0).alpha->read().size(), 3u);
  model = import_square("newmtl oak\nKd 0 1 0\nmap_d mask.png\n");
  EXPECT_FALSE(model.images.at(0).read);
  EXPECT_EQ(material_of(model).base_color, glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(material_of(model).cutoff, 0.5f);
  model = import_square("newmtl oak\nmap_Kd leaf.png\nmap_d -s 3 3 mask.png\n");
  EXPECT_TRUE(warns(model, "textures of what is cut out (map_d) with other options"));
  EXPECT_EQ(material_of(model).cutoff, 0.0f);
}

TEST(ImportObjTextures, emissive_ones_lie_where_the_base_colours_do) {
  write_model("lamp.png", "123");
  const Model model = import_square("newmtl oak\nKd 1 1 1\nmap_Kd lamp.png\nmap_Ke lamp.png\n");
  EXPECT_EQ(material_of(model).emission_texture, 0u);
  EXPECT_EQ(material_of(model).emission, glm::vec3(1)) << "no Ke dims it";
}

TEST(ImportObjTextures, that_a_black_colour_would_hide_are_shown_and_said) {
  write_model("oak.png", "1");
  const Model model = import_square("newmtl oak\nKd 0 0 0\nmap_Kd oak.png\n");
  EXPECT_TRUE(warns(model, "have a texture and a black Kd"));
  EXPECT_EQ(material_of(model).base_color, glm::vec4(1));
}

TEST(ImportObjTextures, of_libraries_that_come_too_late_are_said) {
  write_model("oak.png", "1");
  write_model("a.mtl", "newmtl oak\nmap_Kd oak.png\n");
  const Model model =
      import_text("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl oak\nf 1/1 2/1 3/1\nmtllib a.mtl\n");
  EXPECT_TRUE(warns(model, "behind the first faces are not drawn"));
  EXPECT_EQ(material_of(model).texture, no_id);
}

TEST(ImportObjTextures, are_among_the_files_that_a_build_must_not_overwrite) {
  const auto image = write_model("oak wood.png", "1");
  write_model("a.mtl", "newmtl oak\nmap_Kd -s 2 2 2 oak wood.png\n");
  const auto files = files_of_models({write_model("a.obj", square)});
  EXPECT_EQ(std::ranges::count(files, image), 1);
}

}  // namespace
}  // namespace triptych
