// 3MF: units, axes, items and components, colours, and archives that are damaged.
#include "described.hpp"
#include "placed.hpp"
#include "zip_support.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace triptych {
namespace {

using test::described;
using test::warns;
using test::write_zip;

const std::string tetrahedron =
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"0\"/><vertex x=\"2\" y=\"0\" z=\"0\"/><vertex x=\"0\" "
    "y=\"3\" z=\"0\"/>"
    "<vertex x=\"0\" y=\"0\" z=\"5\"/></vertices><triangles><triangle v1=\"0\" v2=\"2\" v3=\"1\"/>"
    "<triangle v1=\"0\" v2=\"1\" v3=\"3\" pid=\"9\" p1=\"1\"/></triangles></mesh>";

std::string part(const std::string& unit, const std::string& resources, const std::string& build) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model " + unit +
         " xmlns=\"http://schemas.microsoft.com/3dmanufacturing/core/2015/02\"><resources>" + resources +
         "</resources><build>" + build + "</build></model>";
}

Model import_part(const std::string& xml, const ImportOptions& options = {}) {
  return import_model({write_zip("a.3mf", {{"[Content_Types].xml", "<Types/>"}, {"3D/3dmodel.model", xml}})},
                      options);
}

void expect_bounds(const Model& model, size_t triangles, const glm::dvec3& low, const glm::dvec3& high) {
  EXPECT_EQ(test::placed_triangles(model).size(), triangles);
  test::expect_box(model, low, high, 1e-9);
}

const std::string object = "<object id=\"1\" name=\"thing\" type=\"model\">" + tetrahedron + "</object>";

TEST(Import3mf, its_unit_is_applied_and_z_is_up) {
  expect_bounds(import_part(part("unit=\"inch\"", object, "<item objectid=\"1\"/>")), 2, {0, 0, -3 * 0.0254},
                {2 * 0.0254, 5 * 0.0254, 0});
  expect_bounds(import_part(part("", object, "<item objectid=\"1\"/>")), 2, {0, 0, -0.003},
                {0.002, 0.005, 0});
}

TEST(Import3mf, items_and_components_are_placed_by_their_transforms) {
  const std::string turned =
      object +
      "<object id=\"2\"><components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 10 0 0\"/>"
      "<component objectid=\"1\"/></components></object>";
  // A quarter turn about z, then along x; the item moves both along y.
  const Model model = import_part(
      part("unit=\"meter\"", turned, "<item objectid=\"2\" transform=\"1 0 0 0 1 0 0 0 1 0 100 0\"/>"));
  EXPECT_EQ(model.meshes.size(), 1u);
  expect_bounds(model, 4, {0, 0, -103}, {10, 5, -100});
  const Model itself =
      import_part(part("",
                       object + "<object id=\"3\"><components><component objectid=\"3\"/><component "
                                "objectid=\"1\"/></components></object>",
                       "<item objectid=\"3\"/><item objectid=\"8\"/>"));
  EXPECT_TRUE(warns(itself, "1 objects within themselves"));
  EXPECT_TRUE(warns(itself, "1 placements of objects that are not in the file"));
}

TEST(Import3mf, placements_beyond_a_limit_are_counted_and_skipped) {
  ImportOptions options;
  options.max_placements = 100;
  std::string nested = object;
  for (int id = 2; id < 40; ++id) {
    const std::string inner = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
    nested += "<object id=\"" + std::to_string(id) + "\"><components>" + inner + inner +
              "<component objectid=\"99\"/></components></object>";
  }
  const Model model = import_part(part("", nested, "<item objectid=\"39\"/>"), options);
  EXPECT_TRUE(warns(model, "placements beyond 100 were skipped"));
  EXPECT_LE(test::placed_triangles(model).size(), 200u);
}

TEST(Import3mf, without_items_every_object_is_drawn_and_supports_are_not) {
  const Model model = import_part(part("unit=\"meter\"", object, ""));
  expect_bounds(model, 2, {0, 0, -3}, {2, 5, 0});
  EXPECT_TRUE(warns(model, "the build places nothing"));
  const std::string support = "<object id=\"4\" type=\"support\">" + tetrahedron + "</object>";
  EXPECT_TRUE(warns(import_part(part("", object + support, "<item objectid=\"1\"/><item objectid=\"4\"/>")),
                    "1 objects of the types"));
}

TEST(Import3mf, colours_are_those_of_triangles_and_objects) {
  const std::string colors =
      "<basematerials id=\"9\"><base name=\"a\" displaycolor=\"#00FF00\"/><base name=\"b\" "
      "displaycolor=\"#ff0000ff\"/></basematerials>";
  const std::string colored = "<object id=\"1\" pid=\"9\" pindex=\"0\">" + tetrahedron + "</object>";
  const Model model = import_part(part("", colors + colored, "<item objectid=\"1\"/>"));
  const auto color_of = [&](size_t i) {
    return model.materials[model.meshes[0].triangles[i].material].base_color;
  };
  EXPECT_EQ(color_of(0), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(color_of(1), glm::vec4(1, 0, 0, 1));
}

TEST(Import3mf, the_part_that_relationships_name_is_read_and_other_parts_by_path) {
  const std::string root = part("unit=\"meter\"",
                                "<object id=\"2\"><components><component p:path=\"/3D/Objects/o.model\" "
                                "objectid=\"1\"/></components></object>",
                                "<item objectid=\"2\"/>");
  const Model model = import_model({write_zip(
      "a.3mf",
      {{"3D/Objects/o.model", part("unit=\"meter\"", object, "")},
       {"Other/main.model", root},
       {"_rels/.rels",
        "<Relationships><Relationship Target=\"/Other/main.model\" Id=\"r\" "
        "Type=\"http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel\"/></Relationships>"}})});
  expect_bounds(model, 2, {0, 0, -3}, {2, 5, 0});
}

TEST(Import3mf, damage_costs_what_is_damaged) {
  const std::string bad = "<object id=\"1\">" + tetrahedron + "</object>";
  std::string xml = part("unit=\"meter\"", bad, "<item objectid=\"1\"/>");
  xml.replace(xml.find("v3=\"3\""), 6, "v3=\"7\"");
  const Model model = import_part(xml);
  EXPECT_EQ(test::placed_triangles(model).size(), 1u);
  EXPECT_TRUE(warns(model, "1 triangles that name vertices which are not there"));
  const Model cut = import_part(xml.substr(0, xml.find("</resources>")));
  EXPECT_TRUE(
      warns(cut, ": is no XML: it ends before its outermost element is closed; what stands before was read"));
  EXPECT_NE(test::import_error("b.3mf", "PK no archive").find("is not a zip archive"), std::string::npos);
}

TEST(Import3mf, no_damage_makes_it_crash) {
  test::expect_robust(
      "a.3mf", test::bytes_of(write_zip("whole.3mf",
                                        {{"3D/3dmodel.model", part("", object, "<item objectid=\"1\"/>")}})));
}

TEST(Import3mf, placements_with_a_name_a_part_number_or_an_id_are_objects) {
  const std::string assembly =
      object +
      "<object id=\"2\" name=\"box\"><components><component objectid=\"1\" p:UUID=\"u-1\"/><component "
      "objectid=\"3\"/></components></object>" +
      "<object id=\"3\">" + tetrahedron + "</object>";
  const Model model =
      import_part(part("xmlns:p=\"http://schemas.microsoft.com/3dmanufacturing/production/2015/06\"",
                       assembly, "<item objectid=\"2\" partnumber=\"P7\"/><item objectid=\"3\"/>"));
  EXPECT_EQ(described(model),
            (std::vector<std::string>{"box > thing guid u-1 number 1", "box (P7) number 2", "none"}));
  EXPECT_TRUE(import_part(part("", "<object id=\"3\">" + tetrahedron + "</object>", "<item objectid=\"3\"/>"))
                  .source_objects.empty());
}

}  // namespace
}  // namespace triptych
