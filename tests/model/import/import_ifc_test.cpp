// IFC, which triptych-import-ifc reads with web-ifc in Node: shapes, units, places, colours, and what is not
// drawn.
#include "described.hpp"
#include "ifc_files.hpp"
#include "placed.hpp"

namespace triptych {
namespace {

using test::block;
using test::converted_unit;
using test::described;
using test::element;
using test::expect_box;
using test::ifc_file;
using test::import_text;
using test::placed_at;
using test::warns;
using test::write_model;

const std::string wall = element(100, "#110") + block(110, 4, 0.2, 3);

TEST(ImportIfc, a_wall_stands_in_metres_y_up_in_every_schema) {
  for (const char* schema : {"IFC2X3", "IFC4", "IFC4X3_ADD2"}) {
    const Model model = import_text("a.ifc", ifc_file(wall, test::metres, schema));
    EXPECT_EQ(model.placed_triangles(), 12u) << schema;
    expect_box(model, {-2, 0, -0.1}, {2, 3, 0.1});
    EXPECT_EQ(model.meshes.at(0).name, "Wall 100");
    EXPECT_TRUE(model.report.warnings.empty()) << model.report.warnings.front();
  }
}

TEST(ImportIfc, a_byte_order_mark_and_old_line_ends_change_nothing) {
  const std::string text = ifc_file(wall);
  expect_box(import_text("mark.ifc", "\xef\xbb\xbf" + text), {-2, 0, -0.1}, {2, 3, 0.1});
  std::string old;
  for (const char letter : text) old += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  expect_box(import_text("old.ifc", old), {-2, 0, -0.1}, {2, 3, 0.1});
}

TEST(ImportIfc, units_by_prefix_and_by_conversion_come_out_in_metres) {
  const std::pair<std::string, double> units[] = {{std::string(test::millimetres), 0.001},
                                                  {converted_unit("FOOT", "0.3048"), 0.3048},
                                                  {converted_unit("INCH", "0.0254"), 0.0254}};
  for (const auto& [unit, scale] : units) {
    const Model model = import_text("a.ifc", ifc_file(wall, unit));
    expect_box(model, glm::dvec3(-2, 0, -0.1) * scale, glm::dvec3(2, 3, 0.1) * scale);
  }
}

TEST(ImportIfc, a_unit_that_the_file_does_not_name_is_the_users) {
  const auto file = write_model("a.ifc", ifc_file(wall, ""));
  const Model metres = import_model({file});
  expect_box(metres, {-2, 0, -0.1}, {2, 3, 0.1});
  EXPECT_TRUE(warns(metres, "names no unit of length; metres are assumed (--unit says another)"));
  ImportOptions options;
  options.unit = LengthUnit::foot;
  const Model feet = import_model({file}, options);
  expect_box(feet, glm::dvec3(-2, 0, -0.1) * 0.3048, glm::dvec3(2, 3, 0.1) * 0.3048);
  EXPECT_FALSE(warns(feet, "unit"));
  const Model named = import_model({write_model("b.ifc", ifc_file(wall))}, options);
  expect_box(named, {-2, 0, -0.1}, {2, 3, 0.1});
  EXPECT_TRUE(warns(named, "the format says its unit; --unit was not applied"));
}

TEST(ImportIfc, a_site_says_where_on_earth_the_model_stands_and_the_context_where_north_is) {
  const auto site = [](const std::string& latitude, const std::string& longitude) {
    return wall + "#90=IFCSITE('0YvctVUKr0kugbFTf53O9A',#5,'s',$,$,#14,$,$,.ELEMENT.," + latitude + "," +
           longitude + ",12500.,$,$);\n";
  };
  std::string text = ifc_file(site("(48,8,13,200000)", "(-122,-15,-31)"), test::millimetres);
  const Model straight = import_text("a.ifc", text);
  ASSERT_TRUE(straight.geo_place);
  EXPECT_NEAR(straight.geo_place->latitude, 48 + 8 / 60.0 + 13.2 / 3600, 1e-9);
  EXPECT_NEAR(straight.geo_place->longitude, -(122 + 15 / 60.0 + 31 / 3600.0), 1e-9);
  EXPECT_NEAR(straight.geo_place->elevation, 12.5, 1e-9);
  EXPECT_EQ(straight.geo_place->north, glm::dvec2(0, -1));
  const std::string context = "#11,$);\n#13=";
  ASSERT_NE(text.find(context), std::string::npos);
  text.replace(text.find(context), context.size(), "#11,#91);\n#91=IFCDIRECTION((3.,4.));\n#13=");
  const Model turned = import_text("b.ifc", text);
  ASSERT_TRUE(turned.geo_place);
  EXPECT_LT(glm::length(turned.geo_place->north - glm::dvec2(0.6, -0.8)), 1e-9);
  EXPECT_FALSE(import_text("c.ifc", ifc_file(wall)).geo_place);
  EXPECT_FALSE(import_text("d.ifc", ifc_file(site("$", "$"))).geo_place);
  const Model wrong = import_text("e.ifc", ifc_file(site("(95,0,0)", "(0,0,0)")));
  EXPECT_FALSE(wrong.geo_place);
  EXPECT_TRUE(warns(wrong, "the site #90 lies nowhere on Earth"));
}

TEST(ImportIfc, coordinates_of_millions_keep_their_millimetres) {
  const std::string far = element(100, "#110", "IFCWALL", "#120") + block(110, 4, 0.2, 3) +
                          placed_at(120, 2683123.123, 1247456.789, 410.501);
  const glm::dvec3 at(2683123.123, 410.501, -1247456.789);
  expect_box(import_text("a.ifc", ifc_file(far)), at + glm::dvec3(-2, 0, -0.1), at + glm::dvec3(2, 3, 0.1));
}

TEST(ImportIfc, points_of_millions_keep_their_millimetres) {
  const std::string tetrahedron =
      element(100, "#110") +
      "#110=IFCTRIANGULATEDFACESET(#111,$,.T.,((1,2,3),(1,4,2),(2,4,3),(3,4,1)),$);\n"
      "#111=IFCCARTESIANPOINTLIST3D(((2683123.123,1247456.789,410.),(2683123.323,1247456.789,410.),"
      "(2683123.123,1247456.989,410.),(2683123.123,1247456.789,410.2)));\n";
  expect_box(import_text("a.ifc", ifc_file(tetrahedron)), {2683123.123, 410, -1247456.989},
             {2683123.323, 410.2, -1247456.789});
}

TEST(ImportIfc, face_sets_and_indexed_curves_of_ifc4_are_read) {
  const std::string polygons =
      element(100, "#110") +
      "#110=IFCPOLYGONALFACESET(#111,.F.,(#112),$);\n"
      "#111=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(4.,0.,0.),(4.,4.,0.),(0.,4.,0.),(1.,1.,0.),(1.,3.,0.),(3.,3."
      ",0.),"
      "(3.,1.,0.)));\n#112=IFCINDEXEDPOLYGONALFACEWITHVOIDS((1,2,3,4),((5,6,7,8)));\n";
  const Model holed = import_text("polygons.ifc", ifc_file(polygons));
  EXPECT_EQ(holed.placed_triangles(), 8u);
  double area = 0;
  for (const auto& triangle : test::placed_triangles(holed)) {
    const auto& [a, b, c] = triangle.corners;
    area += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  EXPECT_NEAR(area, 12, 1e-6) << "4 x 4 without 2 x 2";
  const std::string curve =
      element(100, "#110") +
      "#110=IFCEXTRUDEDAREASOLID(#111,#11,#9,3.);\n#111=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#112);\n"
      "#112=IFCINDEXEDPOLYCURVE(#113,(IFCLINEINDEX((1,2,3)),IFCARCINDEX((3,4,1))),.F.);\n"
      "#113=IFCCARTESIANPOINTLIST2D(((0.,0.),(4.,0.),(4.,2.),(1.,2.5)));\n";
  EXPECT_GT(import_text("curve.ifc", ifc_file(curve)).placed_triangles(), 12u);
}

TEST(ImportIfc, openings_cut_walls_and_spaces_are_not_drawn) {
  const std::string window =
      wall + element(130, "#140", "IFCOPENINGELEMENT", "#150") + block(140, 1, 1, 1) +
      placed_at(150, 0, 0, 1) + "#160=IFCRELVOIDSELEMENT('0YvctVUKr0kugbFTf53O9T',#5,$,$,#100,#130);\n" +
      "#170=IFCSPACE('0YvctVUKr0kugbFTf53O9U',#5,'s',$,$,#14,#182,$,.ELEMENT.,.INTERNAL.,$);\n"
      "#181=IFCSHAPEREPRESENTATION(#12,'Body','Any',(#190));\n#182=IFCPRODUCTDEFINITIONSHAPE($,$,(#181));\n" +
      block(190, 50, 50, 50);
  const Model model = import_text("a.ifc", ifc_file(window));
  expect_box(model, {-2, 0, -0.1}, {2, 3, 0.1});
  for (const auto& triangle : test::placed_triangles(model)) {
    const glm::dvec3 middle = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]) / 3.0;
    EXPECT_FALSE(std::abs(middle.x) < 0.49 && std::abs(middle.y - 1.5) < 0.49) << "in the opening";
  }
  EXPECT_TRUE(model.report.warnings.empty()) << model.report.warnings.front();
}

TEST(ImportIfc, mapped_items_share_a_mesh_and_scale_it_alone_or_not) {
  const std::string map =
      block(110, 4, 0.2, 3) +
      "#120=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#110));\n#121=IFCREPRESENTATIONMAP(#11,#120);\n"
      "#122=IFCCARTESIANPOINT((10.,20.,30.));\n";
  const auto mapped = [&](int number, const std::string& operation) {
    return element(number, fmt::format("#{}", number + 5)) +
           fmt::format("#{}=IFCMAPPEDITEM(#121,#{});\n#{}={};\n", number + 5, number + 6, number + 6,
                       operation);
  };
  const std::string plain = mapped(100, "IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#8,1.,$)"),
                    twice = mapped(130, "IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#122,2.,$)"),
                    stretched =
                        mapped(130, "IFCCARTESIANTRANSFORMATIONOPERATOR3DNONUNIFORM($,$,#122,2.,$,3.,4.)");
  const Model shared = import_text("a.ifc", ifc_file(map + plain + twice));
  EXPECT_EQ(shared.meshes.size(), 1u);
  EXPECT_EQ(shared.instances.size(), 2u);
  expect_box(import_text("b.ifc", ifc_file(map + twice)), {6, 30, -20.2}, {14, 36, -19.8});
  expect_box(import_text("c.ifc", ifc_file(map + stretched)), {6, 30, -20.3}, {14, 42, -19.7});
}

TEST(ImportIfc, surface_colours_are_those_of_the_display_and_one_shape_in_two_makes_two_meshes) {
  const auto styled = [](int number, const std::string& item, const std::string& colour) {
    return fmt::format(
        "#{0}=IFCSTYLEDITEM({5},(#{1}),$);\n#{1}=IFCSURFACESTYLE($,.BOTH.,(#{2}));\n"
        "#{2}=IFCSURFACESTYLESHADING(#{3},0.);\n#{3}=IFCCOLOURRGB($,{4});\n",
        number, number + 1, number + 2, number + 3, colour, item);
  };
  const std::string two = wall + styled(115, "#110", "0.5,0.25,0.1") +
                          element(200, "#210", "IFCWALL", "#220") + block(210, 4, 0.2, 3) +
                          placed_at(220, 0, 5, 0) + styled(230, "#210", "0.,1.,0.");
  const Model model = import_text("a.ifc", ifc_file(two));
  ASSERT_EQ(model.instances.size(), 2u);
  EXPECT_EQ(model.meshes.size(), 2u);
  const auto triangles = test::placed_triangles(model);
  EXPECT_NEAR(triangles.front().color.r, 0.2140, 1e-3) << "linear";
  EXPECT_NEAR(triangles.front().color.g, 0.0509, 1e-3);
  EXPECT_EQ(triangles.back().color, glm::vec4(0, 1, 0, 1));
}

/// A material that is drawn in a colour, and the objects that are of it. Takes eight numbers.
std::string material(int number, const std::string& objects, const std::string& colour) {
  return fmt::format(
      "#{0}=IFCRELASSOCIATESMATERIAL('0YvctVUKr0kugbFTf5{0}',#5,$,$,({8}),#{1});\n#{1}=IFCMATERIAL('m',$,$);"
      "\n"
      "#{2}=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#{3}),#{1});\n#{3}=IFCSTYLEDREPRESENTATION(#12,$,$,(#{4}"
      "));\n"
      "#{4}=IFCSTYLEDITEM($,(#{5}),$);\n#{5}=IFCSURFACESTYLE($,.BOTH.,(#{6}));\n"
      "#{6}=IFCSURFACESTYLESHADING(#{7},0.);\n#{7}=IFCCOLOURRGB($,{9});\n",
      number, number + 1, number + 2, number + 3, number + 4, number + 5, number + 6, number + 7, objects,
      colour);
}

TEST(ImportIfc, what_has_no_style_has_the_colour_of_its_material_or_else_of_its_types) {
  const std::string type =
      "#500=IFCWALLTYPE('0YvctVUKr0kugbFTf5500',#5,'t',$,$,$,$,$,$,.STANDARD.);\n"
      "#501=IFCRELDEFINESBYTYPE('0YvctVUKr0kugbFTf5501',#5,$,$,(#100),#500);\n";
  const auto color = [&](const std::string& materials) {
    return test::placed_triangles(import_text("a.ifc", ifc_file(wall + type + materials))).front().color;
  };
  const glm::vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1);
  EXPECT_EQ(color(""), glm::vec4(1));
  EXPECT_EQ(color(material(400, "#100", "1.,0.,0.")), red);
  EXPECT_EQ(color(material(400, "#500", "1.,0.,0.")), red);
  EXPECT_EQ(color(material(400, "#500", "1.,0.,0.") + material(410, "#100", "0.,0.,1.")), blue);
  EXPECT_EQ(color(material(400, "#500", "1.,0.,0.") +
                  "#300=IFCSTYLEDITEM(#110,(#301),$);\n#301=IFCSURFACESTYLE($,.BOTH.,(#302));\n"
                  "#302=IFCSURFACESTYLESHADING(#303,0.);\n#303=IFCCOLOURRGB($,0.,0.,1.);\n"),
            blue);
  EXPECT_EQ(color(material(400, "#500,#999", "1.,0.,0.") + "#502=IFCRELDEFINESBYTYPE($,$,$,$,5,#500);\n"),
            red)
      << "relations that are damaged cost only themselves";
}

TEST(ImportIfc, mapped_items_that_share_a_mesh_have_colours_of_their_own) {
  std::string map = block(110, 4, 0.2, 3) +
                    "#120=IFCSHAPEREPRESENTATION(#12,'Body','SweptSolid',(#110));\n"
                    "#121=IFCREPRESENTATIONMAP(#11,#120);\n";
  for (const int number : {100, 200})
    map += element(number, fmt::format("#{}", number + 5)) +
           fmt::format(
               "#{0}=IFCMAPPEDITEM(#121,#{1});\n#{1}=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#8,1.,$);\n"
               "#{2}=IFCSTYLEDITEM(#{0},(#{3}),$);\n#{3}=IFCSURFACESTYLE($,.BOTH.,(#{4}));\n"
               "#{4}=IFCSURFACESTYLESHADING(#{5},0.);\n#{5}=IFCCOLOURRGB($,{6},0.,1.);\n",
               number + 5, number + 6, number + 40, number + 41, number + 42, number + 43,
               number == 100 ? "0." : "1.");
  const Model model = import_text("a.ifc", ifc_file(map));
  const auto triangles = test::placed_triangles(model);
  EXPECT_EQ(triangles.front().color, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(triangles.back().color, glm::vec4(1, 0, 1, 1));
}

TEST(ImportIfc, a_face_set_with_a_colour_for_each_face_is_drawn_in_them) {
  const std::string set = element(100, "#110") +
                          "#110=IFCTRIANGULATEDFACESET(#111,$,.T.,((1,2,3),(1,4,2),(2,4,3),(3,4,1)),$);\n"
                          "#111=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(0.,1.,0.),(0.,0.,1.)));\n"
                          "#112=IFCINDEXEDCOLOURMAP(#110,$,#113,(1,2,1,2));\n"
                          "#113=IFCCOLOURRGBLIST(((1.,0.,0.),(0.,1.,0.)));\n";
  const Model model = import_text("a.ifc", ifc_file(set));
  int red = 0, green = 0;
  for (const auto& triangle : test::placed_triangles(model)) {
    red += triangle.color == glm::vec4(1, 0, 0, 1);
    green += triangle.color == glm::vec4(0, 1, 0, 1);
    const bool is_bottom = triangle.corners[0].y + triangle.corners[1].y + triangle.corners[2].y == 0;
    EXPECT_TRUE(!is_bottom || triangle.color.r == 1) << "the first face";
  }
  EXPECT_EQ(red, 2);
  EXPECT_EQ(green, 2);
}

TEST(ImportIfc, points_by_another_lists_numbers_are_followed) {
  const std::string set =
      element(100, "#110") +
      "#110=IFCTRIANGULATEDFACESET(#111,$,.T.,((1,2,3),(1,4,2),(2,4,3),(3,4,1)),(2,3,4,5));\n"
      "#111=IFCCARTESIANPOINTLIST3D(((99.,99.,99.),(0.,0.,0.),(1.,0.,0.),(0.,1.,0.),(0.,0.,1.)));\n";
  expect_box(import_text("a.ifc", ifc_file(set)), {0, 0, -1}, {1, 1, 0});
}

TEST(ImportIfc, breps_with_voids_and_faces_with_holes_keep_both) {
  std::string text = element(100, "#110") +
                     "#110=IFCFACEBASEDSURFACEMODEL((#111));\n"
                     "#111=IFCCONNECTEDFACESET((#112));\n#112=IFCFACE((#113,#114));\n"
                     "#113=IFCFACEOUTERBOUND(#115,.T.);\n#114=IFCFACEBOUND(#116,.T.);\n"
                     "#115=IFCPOLYLOOP((#120,#121,#122,#123));\n"
                     "#116=IFCPOLYLOOP((#124,#125,#126,#127));\n";
  const char* points[] = {"0.,0.,0.", "4.,0.,0.", "4.,4.,0.", "0.,4.,0.",
                          "1.,1.,0.", "1.,3.,0.", "3.,3.,0.", "3.,1.,0."};
  for (int i = 0; i < 8; ++i) text += fmt::format("#{}=IFCCARTESIANPOINT(({}));\n", 120 + i, points[i]);
  EXPECT_EQ(import_text("hole.ifc", ifc_file(text)).placed_triangles(), 8u);
}

TEST(ImportIfc, products_are_objects_with_guid_kind_storey_and_number) {
  const Model model = import_text("a.ifc", ifc_file(wall));
  EXPECT_EQ(described(model),
            (std::vector<std::string>{"Wall 100 (IfcWall) guid 0YvctVUKr0kugbFTf5100 storey First "
                                      "floor number #100"}));
}

}  // namespace
}  // namespace triptych
