// The process that reads IFC: what it says of objects, of what it cannot read, of what is missing.
#include "ifc_files.hpp"
#include "model/import/converter.hpp"
#include "model/import/scene_stream.hpp"
#include "placed.hpp"

#include <filesystem>

namespace triptych {
namespace {

using test::block;
using test::element;
using test::expect_box;
using test::ifc_file;
using test::import_error;
using test::import_text;
using test::warns;
using test::write_model;

const std::string wall = element(100, "#110") + block(110, 4, 0.2, 3);

class Collected : public SceneSink {
 public:
  void property_set(ScenePropertySet set) override { sets.push_back(std::move(set)); }
  void object(SceneObject object) override { objects.push_back(std::move(object)); }
  void instance(const SceneInstance& instance) override { instances.push_back(instance); }

  std::vector<ScenePropertySet> sets;
  std::vector<SceneObject> objects;
  std::vector<SceneInstance> instances;
};

TEST(IfcReader, objects_come_with_name_guid_kind_storey_layer_and_properties) {
  const std::string described =
      wall +
      "#200=IFCPROPERTYSINGLEVALUE('FireRating',$,IFCLABEL('F90'),$);\n"
      "#201=IFCPROPERTYSINGLEVALUE('IsExternal',$,IFCBOOLEAN(.T.),$);\n"
      "#202=IFCPROPERTYSET('0YvctVUKr0kugbFTf53O9V',#5,'Pset_WallCommon',$,(#200,#201));\n"
      "#203=IFCRELDEFINESBYPROPERTIES('0YvctVUKr0kugbFTf53O9W',#5,$,$,(#100),#202);\n"
      "#204=IFCPRESENTATIONLAYERASSIGNMENT('A-WALL',$,(#101),$);\n";
  const auto file = write_model("a.ifc", ifc_file(described));
  const Converted converted = convert_model(file, nullptr, {}, {"triptych-import-ifc", "web-ifc", {}});
  Collected collected;
  read_scene_stream(converted.output, collected);
  ASSERT_EQ(collected.objects.size(), 1u);
  const SceneObject& object = collected.objects[0];
  EXPECT_EQ(object.id, "#100");
  EXPECT_EQ(object.name, "Wall 100");
  EXPECT_EQ(object.guid, "0YvctVUKr0kugbFTf5100");
  EXPECT_EQ(object.type, "IfcWall");
  EXPECT_EQ(object.storey, "First floor");
  EXPECT_EQ(object.layer, "A-WALL");
  ASSERT_EQ(object.property_sets.size(), 1u);
  const ScenePropertySet& set = collected.sets.at(object.property_sets[0]);
  EXPECT_EQ(set.name, "Pset_WallCommon");
  ASSERT_EQ(set.properties.size(), 2u);
  EXPECT_EQ(set.properties[0], (std::pair<std::string, std::string>("FireRating", "F90")));
  ASSERT_EQ(collected.instances.size(), 1u);
  EXPECT_EQ(collected.instances[0].object, 0u);
}

TEST(IfcReader, an_element_that_cannot_be_read_is_named_and_the_rest_is_drawn) {
  const std::string broken = wall + element(200, "#210", "IFCBEAM") +
                             "#210=IFCEXTRUDEDAREASOLID(#211,#11,#9,3.);\n"
                             "#211=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#212);\n#212=IFCPOLYLINE(());\n" +
                             element(220, "#999", "IFCCOLUMN");
  const Model model = import_text("a.ifc", ifc_file(broken));
  expect_box(model, {-2, 0, -0.1}, {2, 3, 0.1});
  EXPECT_TRUE(warns(model, "#200")) << model.report.warnings.size();
  EXPECT_TRUE(warns(model, "IfcBeam"));
  EXPECT_TRUE(warns(model, "1 IfcColumn have a body of which web-ifc made no triangles: #220"));
}

TEST(IfcReader, a_file_of_spaces_alone_says_why_nothing_is_drawn) {
  const std::string space =
      "#100=IFCSPACE('0YvctVUKr0kugbFTf53O9U',#5,'s',$,$,#14,#102,$,.ELEMENT.,.INTERNAL.,$);\n"
      "#101=IFCSHAPEREPRESENTATION(#12,'Body','Any',(#110));\n#102=IFCPRODUCTDEFINITIONSHAPE($,$,(#101));\n" +
      block(110, 5, 5, 5);
  EXPECT_NE(import_error("a.ifc", ifc_file(space)).find("1 IFCSPACE are not drawn"), std::string::npos);
}

TEST(IfcReader, damaged_and_foreign_files_are_one_line) {
  for (const std::string& text :
       {std::string(), std::string(3000, '\xff'), std::string("solid a\n"), ifc_file(wall).substr(0, 900)})
    EXPECT_NE(import_error("a.ifc", text), "");
  for (size_t i = 1; i < 8; ++i) import_error("cut.ifc", ifc_file(wall).substr(0, i * 400));
}

TEST(IfcReader, a_step_file_that_holds_ifc_is_read_as_ifc) {
  expect_box(import_text("a.stp", ifc_file(wall)), {-2, 0, -0.1}, {2, 3, 0.1});
}

/// A zip archive with one stored entry.
std::string zip_of(const std::string& name, const std::string& contents) {
  const auto number = [](uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i));
    return text;
  };
  const std::string sizes = number(0, 4) + number(contents.size(), 4) + number(contents.size(), 4);
  const std::string common = number(20, 2) + number(0, 8) + sizes + number(name.size(), 2) + number(0, 2);
  const std::string local = "PK\3\4" + common + name + contents;
  const std::string entry =
      "PK\1\2" + number(20, 2) + common + number(0, 2 + 2 + 2 + 4) + number(0, 4) + name;
  return local + entry + "PK\5\6" + number(0, 4) + number(1, 2) + number(1, 2) + number(entry.size(), 4) +
         number(local.size(), 4) + number(0, 2);
}

TEST(IfcReader, an_archive_with_an_ifc_file_is_read) {
  expect_box(import_text("a.ifczip", zip_of("model/a.ifc", ifc_file(wall))), {-2, 0, -0.1}, {2, 3, 0.1});
  EXPECT_NE(import_error("b.ifczip", zip_of("a.txt", "nothing")).find("without an .ifc file"),
            std::string::npos);
}

/// Runs the reader behind these words of a shell, with flags.
ImportOptions reader_with(const std::string& command, const std::string& flags = "") {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "triptych-import-ifc";
  ImportOptions options;
  options.converter =
      write_model("reader", "#!/bin/bash\n" + command + " exec " + program.string() + flags + " \"$@\"\n");
  std::filesystem::permissions(options.converter, std::filesystem::perms::owner_all);
  return options;
}

std::string reader_error(const ImportOptions& options) {
  try {
    import_model({write_model("a.ifc", ifc_file(wall))}, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(IfcReader, a_product_on_which_web_ifc_never_ends_is_left_out) {
  std::string endless = wall + element(200, "#210", "IFCBEAM") + block(210, 1, 1, 1);
  endless.replace(endless.find("REPRESENTATION(", endless.find("#201=")), 15, "REPRESENTATION*");
  const Model model =
      import_model({write_model("a.ifc", ifc_file(endless))}, reader_with("", " --patience 3"));
  expect_box(model, {-2, 0, -0.1}, {2, 3, 0.1});
  EXPECT_TRUE(warns(model, "1 IfcBeam made web-ifc crash or hang and were left out: #200"));
}

TEST(IfcReader, without_node_one_line_says_what_to_install) {
  EXPECT_NE(reader_error(reader_with("PATH=/nonexistent")).find("apt-get install nodejs"), std::string::npos);
}

TEST(IfcReader, too_little_memory_is_one_line) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "the address sanitizer reserves terabytes, and the limit is off";
#endif
  for (const uint64_t megabytes : {100, 200, 250}) {
    ImportOptions options;
    options.converter_bytes = megabytes << 20;
    EXPECT_NE(reader_error(options).find("needs more memory to read than it is given"), std::string::npos)
        << reader_error(options);
  }
}

}  // namespace
}  // namespace triptych
