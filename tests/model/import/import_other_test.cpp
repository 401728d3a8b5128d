// Formats that triptych-import reads with Assimp, and what happens to us when it crashes, hangs or eats
// memory.
#include "described.hpp"
#include "import_support.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <set>
#include <sstream>
#include <sys/resource.h>
#include <zlib.h>

namespace triptych {
namespace {

using test::described;
using test::import_error;
using test::import_text;
using test::warns;
using test::write_model;

const std::string x_file =
    "xof 0303txt 0032\nMesh m { 3; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 0.0;2.0;3.0;; 1; 3;0,1,2;; }\n";
/// A concave face of four corners, and a coordinate that a float cannot hold.
const std::string off = "OFF\n5 1 0\n0 0 0\n4 0 0\n1 1 0\n0 4 0\n1000000.1 0 0\n4 0 1 2 3\n";
const std::string collada =
    "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA "
    "xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
    "version=\"1.4.1\">\n<asset><unit name=\"inch\" meter=\"0.0254\"/><up_axis>Z_UP</up_axis></asset>\n"
    "<library_geometries><geometry id=\"g\" name=\"g\"><mesh><source id=\"p\"><float_array id=\"pa\" "
    "count=\"9\">0 0 0 1 "
    "0 0 0 2 3</float_array><technique_common><accessor source=\"#pa\" count=\"3\" stride=\"3\"><param "
    "name=\"X\" "
    "type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" "
    "type=\"float\"/></accessor></technique_common>"
    "</source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles "
    "count=\"1\"><input "
    "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
    "2</p></triangles></mesh></geometry></library_geometries>\n"
    "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\"><instance_geometry "
    "url=\"#g\"/></node><node id=\"k\">"
    "<translate>10 0 0</translate><instance_geometry "
    "url=\"#g\"/></node></visual_scene></library_visual_scenes>"
    "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";
const std::string fbx =
    "; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXHeaderVersion: 1003\n\tFBXVersion: 7300\n}\n"
    "GlobalSettings:  {\n\tVersion: 1000\n\tProperties70:  {\n\t\tP: \"UpAxis\", \"int\", \"Integer\", "
    "\"\",2\n"
    "\t\tP: \"UnitScaleFactor\", \"double\", \"Number\", \"\",2.54\n\t}\n}\nObjects:  {\n\tGeometry: 1, "
    "\"Geometry::g\", "
    "\"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: 0,0,0,1,0,0,0,2,3\n\t\t}\n\t\tPolygonVertexIndex: *3 "
    "{\n\t\t\ta: 0,1,-3\n\t\t}\n"
    "\t\tGeometryVersion: 124\n\t}\n\tModel: 2, \"Model::m\", \"Mesh\" {\n\t\tVersion: "
    "232\n\t}\n}\nConnections:  {\n\tC: "
    "\"OO\",2,0\n\tC: \"OO\",1,2\n}\n";
/// The corners of every placed triangle, in the model's space.
std::vector<glm::dvec3> placed_corners(const Model& model) {
  std::vector<glm::dvec3> corners;
  for (const Instance& instance : model.instances) {
    const Mesh& mesh = model.meshes[instance.mesh];
    for (const Triangle& triangle : mesh.triangles) {
      for (const uint32_t vertex : triangle.vertices)
        corners.push_back(instance.transform * glm::dvec4(mesh.positions[vertex], 1));
    }
  }
  return corners;
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected) {
  EXPECT_LT(glm::length(found - expected), 1e-6) << found.x << " " << found.y << " " << found.z;
}

TEST(ImportOther, collada_and_fbx_files_say_their_unit_and_axes_and_share_their_meshes) {
  ImportOptions options;
  options.unit = LengthUnit::millimetre;
  for (const auto& file : {write_model("a.dae", collada), write_model("a.fbx", fbx)}) {
    const Model model = import_model({file}, options);
    expect_near(placed_corners(model).at(2), {0, 3 * 0.0254, -2 * 0.0254});
    EXPECT_TRUE(warns(model, "the format says its unit; --unit was not applied"));
  }
  const Model twice = import_text("a.dae", collada);
  EXPECT_EQ(twice.meshes.size(), 1u);
  ASSERT_EQ(twice.instances.size(), 2u);
  expect_near(placed_corners(twice).at(4), {11 * 0.0254, 0, 0});
}

TEST(ImportOther, the_axes_of_fbx_files_are_turned_to_y_up_with_their_front_to_the_viewer) {
  const auto corner = [](const std::string& axes) {
    std::string text = fbx;
    const std::string up = "\t\tP: \"UpAxis\", \"int\", \"Integer\", \"\",2\n";
    text.replace(text.find(up), up.size(), "");
    std::string properties;
    std::istringstream pairs(axes);
    for (std::string name, value; pairs >> name >> value;)
      properties += "\t\tP: \"" + name + "\", \"int\", \"Integer\", \"\"," + value + "\n";
    const std::string unit = "\t\tP: \"UnitScaleFactor\"";
    text.insert(text.find(unit), properties);
    text.replace(text.find(",2.54"), 5, ",100");
    return placed_corners(import_text("a.fbx", text)).at(2);  // 0 2 3 in the file
  };
  expect_near(corner(""), {0, 2, 3});
  expect_near(corner("UpAxis 2 FrontAxis 1 FrontAxisSign -1 CoordAxis 0 CoordAxisSign 1"), {0, 3, -2});
  expect_near(corner("UpAxis 2 FrontAxis 0 FrontAxisSign 1 CoordAxis 1 CoordAxisSign 1"), {2, 3, 0});
  expect_near(corner("UpAxis 0 FrontAxis 2 FrontAxisSign 1 CoordAxis 1 CoordAxisSign -1"), {-2, 0, 3});
  expect_near(corner("UpAxis 1 UpAxisSign -1 CoordAxis 0 CoordAxisSign -1"), {0, -2, 3});
}

TEST(ImportOther, diffuse_colours_of_collada_and_fbx_are_those_displayed) {
  std::string dae = collada;
  const auto insert_before = [](std::string& text, const std::string& place, const std::string& what) {
    text.insert(text.find(place), what);
  };
  insert_before(dae, "<library_geometries>",
                "<library_effects><effect id=\"e\"><profile_COMMON><technique "
                "sid=\"c\"><lambert><diffuse><color>0.5 1 0 1"
                "</color></diffuse></lambert></technique></profile_COMMON></effect></"
                "library_effects><library_materials>"
                "<material id=\"m\"><instance_effect url=\"#e\"/></material></library_materials>");
  dae.replace(dae.find("<triangles count"), 16, "<triangles material=\"s\" count");
  const std::string placed = "<instance_geometry url=\"#g\"/></node><node id=\"k\">";
  dae.replace(
      dae.find(placed), placed.size(),
      "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" "
      "target=\"#m\"/></technique_common></bind_material></instance_geometry></node><node id=\"k\">");
  std::string with_material = fbx;
  insert_before(with_material, "\tModel: 2,",
                "\tMaterial: 3, \"Material::m\", \"\" {\n\t\tVersion: 102\n\t\tShadingModel: "
                "\"lambert\"\n\t\tProperties70:  "
                "{\n\t\t\tP: \"DiffuseColor\", \"Color\", \"\", \"A\",0.5,1,0\n\t\t}\n\t}\n");
  insert_before(
      with_material, "\t\tGeometryVersion",
      "\t\tLayerElementMaterial: 0 {\n\t\t\tVersion: 101\n\t\t\tName: \"\"\n\t\t\tMappingInformationType: "
      "\"AllSame\"\n\t\t\tReferenceInformationType: \"IndexToDirect\"\n\t\t\tMaterials: *1 {\n\t\t\t\ta: "
      "0\n\t\t\t}\n\t\t}\n\t\tLayer: 0 {\n\t\t\tVersion: 100\n\t\t\tLayerElement:  {\n\t\t\t\tType: "
      "\"LayerElementMaterial\"\n\t\t\t\tTypedIndex: 0\n\t\t\t}\n\t\t}\n");
  insert_before(with_material, "C: \"OO\",1,2", "C: \"OO\",3,2\n\t");
  const Model plain = import_text("plain.fbx", fbx);
  EXPECT_EQ(plain.materials[plain.meshes[0].triangles[0].material].base_color, Material().base_color);
  for (const auto& file : {write_model("c.dae", dae), write_model("c.fbx", with_material)}) {
    const Model model = import_model({file});
    const glm::vec4 color = model.materials[model.meshes[0].triangles[0].material].base_color;
    EXPECT_LT(glm::length(color - glm::vec4(0.2140411f, 1, 0, 1)), 1e-4f)
        << file << " " << color.r << " " << color.g;
  }
}

TEST(ImportOther, a_diffuse_texture_of_collada_comes_with_its_coordinates_and_replaces_the_colour) {
  std::string dae = collada;
  const auto insert_before = [&](const std::string& place, const std::string& what) {
    ASSERT_NE(dae.find(place), std::string::npos) << place;
    dae.insert(dae.find(place), what);
  };
  insert_before("<library_geometries>",
                "<library_images><image id=\"i\"><init_from>oak wood.png</init_from></image></library_images>"
                "<library_effects><effect id=\"e\"><profile_COMMON>"
                "<newparam sid=\"f\"><surface type=\"2D\"><init_from>i</init_from></surface></newparam>"
                "<newparam sid=\"s\"><sampler2D><source>f</source></sampler2D></newparam>"
                "<technique sid=\"c\"><lambert><diffuse><texture texture=\"s\" texcoord=\"t\"/></diffuse>"
                "</lambert></technique></profile_COMMON></effect></library_effects><library_materials>"
                "<material id=\"m\"><instance_effect url=\"#e\"/></material></library_materials>");
  dae.replace(dae.find("<triangles count"), 16, "<triangles material=\"s\" count");
  const std::string placed = "<instance_geometry url=\"#g\"/></node><node id=\"k\">";
  dae.replace(
      dae.find(placed), placed.size(),
      "<instance_geometry url=\"#g\"><bind_material><technique_common><instance_material symbol=\"s\" "
      "target=\"#m\"/></technique_common></bind_material></instance_geometry></node><node id=\"k\">");
  insert_before("<vertices id",
                "<source id=\"u\"><float_array id=\"ua\" count=\"6\">0 0 1 0 0.5 0.25</float_array>"
                "<technique_common><accessor source=\"#ua\" count=\"3\" stride=\"2\"><param name=\"S\" "
                "type=\"float\"/><param name=\"T\" type=\"float\"/></accessor></technique_common></source>");
  insert_before("</vertices>", "<input semantic=\"TEXCOORD\" source=\"#u\"/>");
  write_model("oak wood.png", "12345");
  const Model model = import_text("a.dae", dae);
  ASSERT_EQ(model.images.size(), 1u);
  EXPECT_EQ(model.images[0].read().size(), 5u);
  const Mesh& mesh = model.meshes.at(0);
  const Material& material = model.materials[mesh.triangles.at(0).material];
  EXPECT_EQ(material.texture, 0u);
  EXPECT_EQ(material.base_color, glm::vec4(1));
  ASSERT_EQ(mesh.coordinates.size(), 3u);
  EXPECT_EQ(mesh.coordinates[2], texture_coordinates(0.5, 0.75)) << "from the upper corner";
}

TEST(ImportOther, vertex_colours_are_those_displayed_and_no_material_is_made_up_for_them) {
  std::string dae = collada;
  std::string source =
      "<source id=\"c\"><float_array id=\"ca\" count=\"9\">1 0.5 0 1 0.5 0 1 0.5 "
      "0</float_array><technique_common>"
      "<accessor source=\"#ca\" count=\"3\" stride=\"3\">";
  for (const char* channel : {"R", "G", "B"})
    source += std::string("<param name=\"") + channel + "\" type=\"float\"/>";
  dae.insert(dae.find("</vertices>"), "<input semantic=\"COLOR\" source=\"#c\"/>");
  dae.insert(dae.find("<vertices id"), source + "</accessor></technique_common></source>");
  const Model model = import_text("a.dae", dae);
  ASSERT_EQ(model.meshes.at(0).colors.size(), 3u);
  for (const VertexColor& color : model.meshes[0].colors) EXPECT_EQ(color, (VertexColor{255, 128, 0, 255}));
  EXPECT_EQ(model.meshes[0].triangles.at(0).material, 0u);
  EXPECT_FALSE(warns(model, "vertex colours"));
}

std::string x3d_with(const std::string& image) {
  return "<?xml version=\"1.0\"?>\n<X3D><Scene><Shape><Appearance><Material diffuseColor='1 0 0'/>" + image +
         "</Appearance><IndexedFaceSet coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1 "
         "0'/></IndexedFaceSet></Shape></Scene></X3D>";
}

TEST(ImportOther, a_material_has_a_texture_only_where_that_has_a_name) {
  EXPECT_FALSE(warns(import_text("a.x3d", x3d_with("<ImageTexture/>")), "images cannot be read"));
  EXPECT_TRUE(warns(import_text("a.x3d", x3d_with("<ImageTexture url='wood.png'/>")), "wood.png"));
}

TEST(ImportOther, x3d_is_read_whatever_the_quotes_of_its_lists_of_strings) {
  for (const char* url :
       {"'\"wood.png\"'", "\"&quot;wood.png&quot;\"", "\"&#34;wood.png&#34; &#34;b.png&#34;\"",
        " = '\"wood.png\" \"b.png\"'", "' \"wood.png\"'", "\"wood.png\""}) {
    const std::string assigned = url[0] == ' ' ? std::string("url") + url : std::string("url=") + url;
    const Model model = import_text("a.x3d", x3d_with("<ImageTexture " + assigned + "/>"));
    EXPECT_EQ(model.source_triangles(), 1u) << url;
    EXPECT_TRUE(warns(model, "wood.png")) << url;
  }
}

TEST(ImportOther, a_byte_order_mark_and_gzip_around_a_file_are_taken_off) {
  EXPECT_EQ(import_text("a.off", "\xef\xbb\xbf" + off).source_triangles(), 2u);
  const auto file = write_model("packed", "");
  const gzFile out = gzopen(file.c_str(), "wb");
  gzwrite(out, off.data(), static_cast<unsigned>(off.size()));
  gzclose(out);
  const auto renamed = file.parent_path() / "a.off.gz";
  std::filesystem::rename(file, renamed);
  EXPECT_EQ(import_model({renamed}).source_triangles(), 2u);
}

TEST(ImportOther, x_and_off_files_are_read_and_concave_faces_cut_properly) {
  EXPECT_EQ(import_text("a.x", x_file).source_triangles(), 1u);
  const Model model = import_text("a.off", off);
  const auto corners = placed_corners(model);
  ASSERT_EQ(corners.size(), 6u);
  for (size_t i = 0; i < 6; i += 3) {
    const glm::dvec3 normal = glm::cross(corners[i + 1] - corners[i], corners[i + 2] - corners[i]);
    EXPECT_GT(normal.z, 0);
  }
  EXPECT_TRUE(warns(model, "the largest is 1000000.12, where a step is 0.0625"));
}

TEST(ImportOther, large_meshes_stream_from_a_file_without_a_name) {
  ImportOptions options;
  options.stream_above = 0;
  options.temporary_folder = test::empty_folder("temporary");
  const Model model = import_model({write_model("a.off", off)}, options);
  ASSERT_TRUE(model.meshes[0].stream);
  uint64_t count = 0;
  model.meshes[0].stream->read([&](auto batch) { count += batch.size(); });
  EXPECT_EQ(count, 2u);
  EXPECT_TRUE(std::filesystem::is_empty(options.temporary_folder));
}

TEST(ImportOther, damaged_and_empty_files_are_one_line) {
  for (const char* name : {"a.dae", "a.fbx", "a.3ds", "a.off", "a.x", "a.blend"}) {
    EXPECT_NE(import_error(name, ""), "") << name;
    EXPECT_NE(import_error(name, std::string(3000, '\xff')), "") << name;
  }
  EXPECT_THROW(import_model({"/nonexistent/a.off"}), Error);
}

TEST(ImportOther, every_format_that_is_listed_is_one_that_assimp_claims) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "triptych-import";
  std::FILE* pipe = ::popen((program.string() + " --formats").c_str(), "r");
  ASSERT_TRUE(pipe);
  std::string claimed = ";";
  for (int letter; (letter = std::fgetc(pipe)) != EOF;)
    claimed += static_cast<char>(letter == '\n' ? ';' : letter);
  EXPECT_EQ(::pclose(pipe), 0);
  const std::set<std::string> others = {".iges", ".igs"};  // formats that Assimp does not know
  for (const std::string& extension : known_extensions()) {
    if (others.count(extension) > 0) continue;
    EXPECT_NE(claimed.find(";*" + extension + ";"), std::string::npos) << extension;
  }
}

/// A program in place of triptych-import, which writes something first.
ImportOptions converter(const std::string& script) {
  ImportOptions options;
  options.converter = write_model("converter", "#!/bin/sh\n" + script + "\n");
  std::filesystem::permissions(options.converter, std::filesystem::perms::owner_all);
  options.temporary_folder = test::empty_folder("temporary");
  options.converter_seconds = 0.5;
  return options;
}

std::string converter_error(const std::string& script) {
  const ImportOptions options = converter(script);
  const auto file = write_model("a.off", off);
  std::string message;
  try {
    import_model({file}, options);
  } catch (const Error& error) {
    message = error.what();
    EXPECT_EQ(message.find(file.string() + ": "), 0u) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_TRUE(std::filesystem::is_empty(options.temporary_folder));
  return message;
}

TEST(ImportOther, a_reader_that_crashes_hangs_or_gives_up_is_one_line_and_leaves_no_file) {
  EXPECT_NE(converter_error("kill -SEGV $$").find("makes its reader crash (signal 11"), std::string::npos);
  EXPECT_NE(converter_error("echo half >&3; exec sleep 60").find("takes more than 0.5 s"), std::string::npos);
  EXPECT_NE(converter_error("exec 2>&-; exec sleep 60").find("takes more than 0.5 s"), std::string::npos);
  EXPECT_NE(converter_error("exit 7").find("exit code 7"), std::string::npos);
  EXPECT_NE(
      converter_error("echo noise >&2; echo 'triptych: no such thing' >&2; exit 1").find(": no such thing"),
      std::string::npos);
  EXPECT_NE(converter_error("head -c 3000000 /dev/zero >&2; kill -ABRT $$").find("signal 6"),
            std::string::npos);
}

TEST(ImportOther, a_reader_that_a_limit_of_the_shell_starves_is_told_in_our_words) {
  const std::string node =
      "echo '# Fatal process OOM in Failed to reserve virtual memory' >&2; kill -TRAP $$";
  const std::string unlimited = converter_error(node);
  EXPECT_TRUE(unlimited.ends_with("needs more memory to read than it is given")) << unlimited;
  rlimit before{};
  ::getrlimit(RLIMIT_AS, &before);
  const rlimit low{std::min<rlim_t>(rlim_t{64} << 30, before.rlim_max), before.rlim_max};
  ::setrlimit(RLIMIT_AS, &low);
  const std::string limited = converter_error(node);
  ::setrlimit(RLIMIT_AS, &before);
  EXPECT_NE(limited.find("address space is limited (ulimit -v)"), std::string::npos) << limited;
}

TEST(ImportOther, what_a_reader_claims_to_have_read_is_checked) {
  EXPECT_NE(converter_error("exit 0"), "");
  EXPECT_NE(converter_error("printf 'glTF\\2\\0\\0\\0\\377\\377\\377\\377aaaabbbbcccc' >&3")
                .find("the first chunk is not JSON"),
            std::string::npos);
}

TEST(ImportOther, a_reader_that_takes_too_much_memory_is_one_line) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer reserves terabytes, and the limit is off";
#endif
  ImportOptions options;
  options.converter_bytes = 512 << 20;
  try {
    import_model({write_model("large.off", "OFF\n200000000 1 0\n0 0 0\n")}, options);
    FAIL() << "2.4 GB were at hand";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("memory"), std::string::npos) << error.what();
  }
}

TEST(ImportOther, a_program_that_is_not_there_is_named) {
  ImportOptions options;
  options.converter = "/nonexistent/triptych-import";
  try {
    import_model({write_model("a.off", off)}, options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/triptych-import"), std::string::npos);
  }
}

TEST(ImportOther, nodes_are_objects_by_their_names_and_what_assimp_makes_up_is_none) {
  EXPECT_EQ(described(import_text("a.dae", collada)), (std::vector<std::string>{"n", "k"}));
  std::string named = collada;
  named.replace(named.find("<node id=\"n\">"), 13, "<node id=\"n\" name=\"Left &lt;wing\">");
  EXPECT_EQ(described(import_text("a.dae", named)), (std::vector<std::string>{"Left <wing", "k"}));
  named.replace(named.find("<node id=\"k\">"), 13, "<node>");
  EXPECT_EQ(described(import_text("a.dae", named)), (std::vector<std::string>{"Left <wing", "g"}));
  EXPECT_EQ(described(import_text("a.fbx", fbx)), (std::vector<std::string>{"m"}));
  EXPECT_EQ(described(import_text("a.off", off)), (std::vector<std::string>{"none"}));
}

}  // namespace
}  // namespace triptych
