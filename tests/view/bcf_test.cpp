// Viewpoints of BCF: written, read again, read as others write them, and refused where they are damaged.
#include "view/bcf/bcf.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "view/bcf/xml_tree.hpp"
#include "view/bcf/zip_file.hpp"
#include "view/last_place.hpp"
#include "view/sections.hpp"
#include "view/viewpoint.hpp"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

/// One with an IFC GUID, one with another.
SourceObjects two_objects() {
  SourceObjects source;
  for (const std::string guid : {"0123456789abcdefABCD_$", "no guid"}) {
    SourceObject object;
    object.guid = source.texts.add(guid);
    source.objects.push_back(object);
  }
  return source;
}

const std::string version_2_1 = "<Version VersionId=\"2.1\"/>", version_3 = "<Version VersionId=\"3.0\"/>";
const std::string markup_2_1 =
    "<Markup><Topic Guid=\"t\"><Title>A gap &amp; more</Title></Topic>"
    "<Viewpoints Guid=\"v\"><Viewpoint>a.bcfv</Viewpoint></Viewpoints></Markup>";
const std::string markup_3 =
    "<Markup><Topic Guid=\"t\"><Title>A gap &amp; more</Title><Viewpoints><ViewPoint Guid=\"v\">"
    "<Viewpoint>a.bcfv</Viewpoint></ViewPoint></Viewpoints></Topic></Markup>";

std::string vector(const std::string& name, const std::string& x, const std::string& y,
                   const std::string& z) {
  return "<" + name + "><X>" + x + "</X><Y>" + y + "</Y><Z>" + z + "</Z></" + name + ">";
}
std::string camera(const std::string& fov = "50", const std::string& x = "1.5") {
  return "<PerspectiveCamera>" + vector("CameraViewPoint", x, "-2", "3") +
         vector("CameraDirection", "0", "1", "0") + vector("CameraUpVector", "0", "0", "1") +
         "<FieldOfView>" + fov + "</FieldOfView></PerspectiveCamera>";
}
std::string view(const std::string& inner) {
  return "<?xml version=\"1.0\"?><VisualizationInfo Guid=\"v\">" + inner + "</VisualizationInfo>";
}

class BcfFile : public testing::Test {
 protected:
  BcfFile()
      : file(std::filesystem::path(testing::TempDir()) /
             ("triptych_" + std::to_string(::getpid()) + ".bcfzip")) {}
  ~BcfFile() override { std::filesystem::remove(file); }

  void write(const std::string& version, const std::string& markup, const std::string& viewpoint) const {
    ZipWriter zip(file);
    zip.add("bcf.version", version);
    zip.add("t/markup.bcf", markup);
    zip.add("t/a.bcfv", viewpoint);
    zip.commit();
  }
  /// What is said of the file.
  std::string failure() const {
    try {
      read_bcf(file);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const std::filesystem::path file;
};

TEST_F(BcfFile, holds_what_was_written) {
  for (const bool orthogonal : {false, true}) {
    Viewpoint viewpoint;
    viewpoint.title = "<Door> & \"wall\"";
    viewpoint.camera.eye = {5'400'000.125, 12, -3.5};
    viewpoint.camera.target = viewpoint.camera.eye + glm::dvec3(3, -1, 2);
    viewpoint.camera.up = {0, 1, 0};
    viewpoint.camera.fov_y_degrees = 75;
    if (orthogonal) viewpoint.camera.orthographic_height = 12.5;
    viewpoint.selected = {"0123456789abcdefABCD_$"};
    viewpoint.shows_others = orthogonal;
    viewpoint.exceptions = {"1123456789abcdefABCD_$", "2123456789abcdefABCD_$"};
    viewpoint.planes = {{{0, 1, 0}, 2}, {glm::normalize(glm::dvec3(1, 2, -2)), -7}};
    write_bcf(file, viewpoint, {}, time_text());
    const std::vector<Viewpoint> again = read_bcf(file);
    ASSERT_EQ(again.size(), 1u);
    const Viewpoint& read = again[0];
    EXPECT_EQ(read.title, viewpoint.title);
    EXPECT_EQ(read.camera.eye, viewpoint.camera.eye) << "to the last digit";
    const glm::dvec3 direction = glm::normalize(viewpoint.camera.target - viewpoint.camera.eye);
    EXPECT_LT(glm::distance(read.camera.target - read.camera.eye, direction), 1e-8);
    EXPECT_NEAR(glm::dot(read.camera.up, direction), 0, 1e-12) << "at right angles";
    EXPECT_GT(read.camera.up.y, 0.5);
    EXPECT_EQ(read.camera.orthographic_height.has_value(), orthogonal);
    EXPECT_EQ(orthogonal ? *read.camera.orthographic_height : read.camera.fov_y_degrees,
              orthogonal ? 12.5 : 75);
    EXPECT_EQ(read.selected, viewpoint.selected);
    EXPECT_EQ(read.shows_others, orthogonal);
    EXPECT_EQ(read.exceptions, viewpoint.exceptions);
    ASSERT_EQ(read.planes.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
      EXPECT_LT(glm::distance(read.planes[i].normal, viewpoint.planes[i].normal), 1e-12);
      EXPECT_NEAR(read.planes[i].offset, viewpoint.planes[i].offset, 1e-12);
    }
    EXPECT_TRUE(read.left_out.empty());
  }
}

TEST_F(BcfFile, is_in_metres_with_z_up) {
  write(version_2_1, markup_2_1,
        view(camera() + "<ClippingPlanes><ClippingPlane>" + vector("Location", "0", "4", "0") +
             vector("Direction", "0", "2", "0") + "</ClippingPlane></ClippingPlanes>"));
  const Viewpoint read = read_bcf(file).front();
  EXPECT_EQ(read.title, "A gap & more");
  EXPECT_EQ(read.camera.eye, glm::dvec3(1.5, 3, 2));
  EXPECT_EQ(read.camera.target, glm::dvec3(1.5, 3, 1)) << "y of BCF is −z here";
  EXPECT_EQ(read.camera.up, glm::dvec3(0, 1, 0));
  // The direction points to what is cut away: all beyond y = 4, which is z below −4 here.
  ASSERT_EQ(read.planes.size(), 1u);
  EXPECT_GT(read.planes[0].distance({0, 0, -3}), 0);
  EXPECT_LT(read.planes[0].distance({0, 0, -5}), 0);
  EXPECT_FALSE(section_of(read, "test").keeps_all());
}

TEST_F(BcfFile, of_version_3_has_its_viewpoints_in_the_topic) {
  write(version_3, markup_3, view("<Components><Visibility/></Components>" + camera()));
  const Viewpoint read = read_bcf(file).front();
  EXPECT_EQ(read.camera.fov_y_degrees, 50);
  EXPECT_FALSE(read.shows_others) << "which is what no attribute says";
  EXPECT_EQ(left_out_text(read, {}), "");
  EXPECT_EQ(hidden_by(read, two_objects()), (ObjectSet{0, 1}));
}

TEST_F(BcfFile, says_what_of_it_is_not_shown) {
  write(
      version_2_1, markup_2_1,
      view(
          "<Components><Visibility DefaultVisibility=\"true\"><Exceptions><Component IfcGuid=\"a\"/>"
          "<Component IfcGuid=\"b\"/></Exceptions></Visibility><Coloring><Color Color=\"FF0000\"/></Coloring>"
          "</Components>" +
          camera() + "<Lines><Line/></Lines><Bitmap/>"));
  const Viewpoint read = read_bcf(file).front();
  EXPECT_EQ(left_out_text(read, {}),
            "colours, lines, bitmaps, 2 of 2 objects that are hidden, which the model does not have");
}

TEST_F(BcfFile, that_is_damaged_is_one_error_with_its_place) {
  EXPECT_NE(failure().find("is no file"), std::string::npos);
  const auto says = [&](const std::string& viewpoint, const std::string& words) {
    write(version_2_1, markup_2_1, viewpoint);
    const std::string text = failure();
    EXPECT_NE(text.find(words), std::string::npos) << text;
    EXPECT_NE(text.find("t/a.bcfv"), std::string::npos) << text;
  };
  says(view(""), "has no camera");
  says(view(camera("nan")), "is no finite number");
  says(view(camera("50", "1e999")), "is no finite number");
  says(view(camera("50", "inf")), "is no finite number");
  says(view(camera("50", "1.5x")), "is no finite number");
  says(view(camera("0")), "<FieldOfView>");
  says(view(camera("180")), "<FieldOfView>");
  says("<VisualizationInfo><a></VisualizationInfo>",
       "line 1, column 25: is no XML: what is closed here is not the element that is open");
  says("", "is no XML: it ends before");
  says("<Markup/>", "is no viewpoint");
  says("<!DOCTYPE a [<!ENTITY b \"c\">]>" + view(camera()), "document type definition");
  std::string deep;
  for (int i = 0; i < 100; ++i) deep += "<a>";
  says(deep, "too many elements within each other");
  says(view(camera()) + std::string(17 << 20, ' '), "unpacks to more than 16 MiB");
  const std::string up_along_sight = "<PerspectiveCamera>" + vector("CameraViewPoint", "1", "2", "3") +
                                     vector("CameraDirection", "0", "0", "1") +
                                     vector("CameraUpVector", "0", "0", "1") +
                                     "<FieldOfView>50</FieldOfView></PerspectiveCamera>";
  says(view(up_along_sight), "up vector lies along");
  write("<Version VersionId=\"2.0\"/>", markup_2_1, view(camera()));
  EXPECT_NE(failure().find("versions 2.1 and 3.0 are read"), std::string::npos) << failure();
  write(version_2_1, "<Markup><Topic Guid=\"t\"/></Markup>", view(camera()));
  EXPECT_NE(failure().find("has no viewpoints"), std::string::npos) << failure();
  write(version_2_1, "<Markup><Viewpoints><Viewpoint>../../b.bcfv</Viewpoint></Viewpoints></Markup>",
        view(camera()));
  EXPECT_NE(failure().find("is not in the archive"), std::string::npos) << failure();
  {
    ZipWriter zip(file);
    zip.add("readme.txt", std::string("hello"));
    zip.commit();
  }
  EXPECT_NE(failure().find("is no BCF"), std::string::npos) << failure();
  write_file(file, "no archive");
  EXPECT_NE(failure().find("is not a zip archive"), std::string::npos) << failure();
}

TEST_F(BcfFile, that_is_cut_or_changed_never_crashes_a_reader) {
  write(version_2_1, markup_2_1, view(camera()));
  const std::string whole = read_text_file(file);
  for (size_t i = 0; i < whole.size(); i += 7) {
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 0x55);
    write_file(file, changed);
    failure();
    write_file(file, whole.substr(0, i));
    EXPECT_NE(failure(), "") << "cut at byte " << i;
  }
}

TEST(Viewpoint, hides_what_it_names_or_all_the_rest) {
  const SourceObjects source = two_objects();
  Viewpoint viewpoint;
  EXPECT_EQ(hidden_by(viewpoint, source), ObjectSet());
  viewpoint.exceptions = {"0123456789abcdefABCD_$", "unknown"};
  EXPECT_EQ(hidden_by(viewpoint, source), ObjectSet{0});
  EXPECT_EQ(left_out_text(viewpoint, source),
            "1 of 2 objects that are hidden, which the model does not have");
  viewpoint.shows_others = false;
  EXPECT_EQ(hidden_by(viewpoint, source), ObjectSet{1});
}

TEST(Viewpoint, names_the_selection_by_its_ifc_guid) {
  SourceObjects source = two_objects();
  FrameState frame;
  frame.section.set_box({{0, 0, 0}, {1, 2, 3}}, "test");
  Selection selection;
  selection.name = "Wall";
  selection.object = 0;
  Selected selected;
  selected.set(selection);
  const Viewpoint viewpoint = viewpoint_of({}, frame, source, selected, "room");
  EXPECT_EQ(viewpoint.selected, std::vector<std::string>{"0123456789abcdefABCD_$"});
  EXPECT_EQ(viewpoint.title, "room: Wall");
  EXPECT_EQ(viewpoint.planes.size(), 6u) << "the sides of the box";
  selection.object = 1;
  selected.toggle(selection);
  const Viewpoint of_both = viewpoint_of({}, frame, source, selected, "room");
  EXPECT_EQ(of_both.selected, viewpoint.selected) << "the other has no IFC GUID";
  EXPECT_EQ(of_both.title, "room: 2 objects");
  EXPECT_EQ(not_saved_text(frame, source, selected),
            "1 of 2 objects that are selected: they have no IFC GUID");
  EXPECT_EQ(not_saved_text(frame, source, {}), "");
  const std::vector<std::string> wanted = {"no guid", "unknown"};
  EXPECT_EQ(objects_of(source, wanted), std::vector<SourceObjectId>{1});
}

TEST(Viewpoint, has_the_box_of_what_is_selected_again_that_the_same_key_takes_away) {
  const Sections::Scene scene{.eye = {0, 0, 9},
                              .under_cursor = std::nullopt,
                              .box = {{1.0 / 3, 2.0 / 7, 1}, {5, 2.1, 3.3}},
                              .is_selected = true};
  Sections sections(Section(), 10);
  sections.take(Command::toggle_section_box, scene);
  ASSERT_TRUE(sections.section().box());
  // As a file has it: rounded, and turned to z up and back.
  Viewpoint viewpoint;
  viewpoint.planes = planes_of(sections.section());
  for (SectionPlane& plane : viewpoint.planes) plane.offset += plane.offset * 1e-9;
  const Section read = section_of(viewpoint, "test");
  ASSERT_TRUE(read.box());
  EXPECT_NE(read, sections.section());
  sections.begin_at(read);
  sections.take(Command::toggle_section_box, scene);
  EXPECT_FALSE(sections.section().box()) << "the same again: no box";
  sections.begin_at(read);
  Sections::Scene other = scene;
  other.box.hi.x += 0.01;
  sections.take(Command::toggle_section_box, other);
  EXPECT_TRUE(sections.section().box()) << "of something else";
}

TEST(Viewpoint, has_a_box_and_planes_again_though_bcf_has_planes_only) {
  Section section;
  section.add_plane({{0, 0.6, 0.8}, 1.0 / 3}, "test");
  section.set_box({{-1.0 / 3, 0, 2}, {1, 2, 1e7}}, "test");
  for (int i = 0; i < 5; ++i) section.add_plane({{1, 0, 0}, 0.1 * i}, "test");
  Viewpoint viewpoint;
  viewpoint.planes = planes_of(section);
  ASSERT_EQ(viewpoint.planes.size(), 12u) << "more than there may be, but for the box";
  const Section again = section_of(viewpoint, "test");
  EXPECT_EQ(again.planes().size(), 6u);
  ASSERT_TRUE(again.box());
  // What both keep is the same; which of two parallel planes is a side of the box may be another.
  for (const glm::dvec3& point :
       {glm::dvec3(0.45, 1, 3), {0.35, 1, 3}, {0.45, -0.1, 3}, {0.9, 1.5, 1e7 + 1}}) {
    const auto keeps = [&](const Section& of) {
      const SectionSides sides(of);
      return std::ranges::all_of(sides.all(),
                                 [&](const SectionPlane& side) { return side.distance(point) >= 0; });
    };
    EXPECT_EQ(keeps(again), keeps(section)) << point.x;
  }
  section = {};
  section.set_box({{-1.0 / 3, 0, 2}, {1, 2, 1e7}}, "test");
  viewpoint.planes = planes_of(section);
  EXPECT_EQ(section_of(viewpoint, "test"), section);
  viewpoint.planes.pop_back();
  EXPECT_FALSE(section_of(viewpoint, "test").box()) << "five sides are no box";
}

TEST(LastPlace, is_read_as_it_was_written_and_refused_where_it_is_damaged) {
  LastPlace place;
  place.camera.eye = {1.25, -2e7, 1.0 / 3};
  place.camera.target = {0, 1, 2};
  place.camera.up = {0, 1, 0};
  place.camera.orthographic_height = 7;
  place.camera.near = 0.125;
  place.pace = 1.25;
  place.edges = true;
  place.selected = {17, 3};
  place.picked = {
      {.drawable = 7, .placement = 2, .triangle = 9, .point = {1, 2, 1.0 / 3}, .normal = {0, 1, 0}}};
  place.measured = {{.points = {{0, 0, 0}, {1.0 / 3, 0, 0}, {0, 1, 0}}, .closed = true},
                    {.points = {{4, 5, 6}, {7, 8, 9}}, .to_face = 1.0 / 7},
                    {}};
  place.section.add_plane({{0, 0.6, -0.8}, 1.0 / 3}, "test");
  place.section.set_box({{-1, -2, -3}, {1, 2, 1e7}}, "test");
  place.hidden = {1, 2, 3, 7, 9, 10};
  EXPECT_EQ(parse_last_place(last_place_text(place), "place").section, place.section);
  const LastPlace again = parse_last_place(last_place_text(place), "place");
  EXPECT_EQ(again.hidden, place.hidden);
  EXPECT_EQ(again.selected, place.selected);
  ASSERT_EQ(again.picked.size(), 1u);
  EXPECT_EQ(again.picked[0].point, place.picked[0].point);
  EXPECT_EQ(again.measured, place.measured);
  const std::string text = last_place_text(place);
  EXPECT_EQ(last_place_text(parse_last_place(text, "place")), text);
  for (size_t i = 0; i + 1 < text.size(); i += 3)
    EXPECT_THROW(parse_last_place(text.substr(0, i), "place"), Error) << i;
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("triptych_place_" + std::to_string(::getpid()) + ".json");
  PlaceKeeper keeper(file);
  EXPECT_FALSE(keeper.read());
  EXPECT_TRUE(keeper.keep(place));
  EXPECT_EQ(keeper.read()->camera.eye, place.camera.eye);
  place.camera.eye.x = 9;
  EXPECT_FALSE(keeper.keep(place)) << "not at once";
  write_file(file, "{");
  EXPECT_FALSE(keeper.read()) << "begins at the start";
  std::filesystem::remove(file);
}

TEST(Bcf, a_box_is_found_among_planes_along_the_axes) {
  Section section;
  section.set_box({{0, 0, 0}, {1, 2, 3}}, "a test");
  section.add_plane({{1, 0, 0}, 5}, "a test");  // beyond the box: nothing is left
  section.add_plane({{0, -1, 0}, -0.5}, "a test");
  Viewpoint viewpoint;
  viewpoint.planes = planes_of(section);
  EXPECT_EQ(section_of(viewpoint, "a test"), section);
}

}  // namespace
}  // namespace triptych
