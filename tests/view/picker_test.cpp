// What is under the cursor: against every triangle of the cut, one by one.
#include "view/picker.hpp"

#include "base/file.hpp"
#include "lod/cut.hpp"
#include "lod/frame_view.hpp"
#include "tests/support/drawable_triangles.hpp"
#include "tests/support/scenes.hpp"
#include "view/sections.hpp"
#include "view/tour.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

/// How far along the way a ray meets the triangle; infinite where it does not. By areas, as no product of the
/// picker does it.
double meet(const glm::dvec3& from, const glm::dvec3& way, const judge::Corners& corners) {
  const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double along = glm::dot(corners[0] - from, normal) / glm::dot(way, normal);
  const glm::dvec3 at = from + along * way;
  double area = 0;
  for (size_t k = 0; k < 3; ++k) area += glm::length(glm::cross(corners[k] - at, corners[(k + 1) % 3] - at));
  const bool inside = area <= glm::length(normal) * (1 + 1e-7);
  return inside && std::isfinite(along) ? along : 1e300;
}

TEST(Picker, finds_the_nearest_triangle_of_what_is_shown) {
  for (const std::string name : {"room", "instances", "far", "storeys"}) {
    const Pack& pack = scenes::pack(name);
    const Skeleton& skeleton = pack.skeleton();
    Picker picker(pack);
    int hits = 0, views = 0;
    for (const View& view : scenes::random_views(skeleton, 40, 30, 12, 7)) {
      const std::vector<DrawableId> shown = select_cut(FrameView(skeleton, {view, 4})).drawables;
      ++views;
      for (const auto& [x, y] : {std::pair{20.0, 15.0}, {7.5, 9.5}, {33.25, 21.0}}) {
        const glm::dvec3 near = Picker::place_at(view, x, y, view.camera.near);
        const glm::dvec3 way = Picker::place_at(view, x, y, view.camera.near + 1) - near;
        double nearest = 1e300;
        for (const DrawableId id : shown) {
          for (const judge::Corners& corners : judge::triangles_of(pack, id)) {
            const double along = meet(near, way, corners);
            if (along >= 0) nearest = std::min(nearest, along);
          }
        }
        const auto picked = picker.at({view}, shown, x, y);
        ASSERT_EQ(picked.has_value(), nearest < 1e300)
            << name << " view " << views << " at " << x << ", " << y;
        if (!picked) continue;
        ++hits;
        EXPECT_NEAR(glm::dot(picked->point - near, way) / glm::dot(way, way), nearest,
                    1e-6 * (nearest + glm::length(near)))
            << name << " view " << views;
        const auto triangles = judge::triangles_of(pack, picked->drawable);
        double to_own = 1e300;
        for (const judge::Corners& corners : triangles)
          to_own = std::min(to_own, meet(near, way, corners) - nearest);
        EXPECT_LE(to_own, 1e-6 * (nearest + glm::length(near))) << "the drawable is the one that is met";
      }
    }
    EXPECT_GT(hits, views / 2) << name;
  }
}

TEST(Picker, finds_nothing_that_a_section_cuts_away) {
  const Pack& pack = scenes::pack("room");
  const Skeleton& skeleton = pack.skeleton();
  const Box box = skeleton.lattice().box(skeleton.scene_nodes.front().box);
  Picker picker(pack);
  scenes::Random random(4);
  int kept = 0, caps = 0, gone = 0;
  for (const View& view : scenes::random_views(skeleton, 40, 30, 60, 7)) {
    FrameState state{view, 0};
    const glm::dvec3 normal = glm::normalize(random.vector(-1, 1) + glm::dvec3(0, 0, 1e-3));
    state.section.add_plane({normal, glm::dot(normal, box.lo + (box.hi - box.lo) * random.vector(0.2, 0.8))},
                            "test");
    const SectionPlane plane = state.section.planes()[0];
    const std::vector<DrawableId> shown = select_cut(FrameView(skeleton, state)).drawables;
    const glm::dvec3 near = Picker::place_at(view, 20, 15, view.camera.near);
    const glm::dvec3 way = Picker::place_at(view, 20, 15, view.camera.near + 1) - near;
    double nearest = 1e300;
    for (const DrawableId id : shown) {
      for (const judge::Corners& corners : judge::triangles_of(pack, id)) {
        const double along = meet(near, way, corners);
        if (along >= 0 && along < 1e300 && plane.distance(near + along * way) >= 0)
          nearest = std::min(nearest, along);
      }
    }
    const auto picked = picker.at(state, shown, 20, 15);
    ASSERT_EQ(picked.has_value(), nearest < 1e300);
    gone += !picked;
    if (!picked) continue;
    const double size = glm::length(near) + nearest;
    EXPECT_GE(plane.distance(picked->point), -1e-5 * size);
    EXPECT_LE(glm::dot(picked->normal, way), 0) << "normals are towards the eye";
    const double along = glm::dot(picked->point - near, way) / glm::dot(way, way);
    if (std::abs(along - nearest) <= 1e-6 * size) {
      ++kept;
    } else {  // before it, where the ray comes in
      ++caps;
      EXPECT_LT(along, nearest);
      EXPECT_NEAR(plane.distance(picked->point), 0, 1e-5 * size);
    }
  }
  EXPECT_GT(kept, 10);
  EXPECT_GT(caps, 2);
  EXPECT_GT(gone, 0);
}

TEST(Sections, begin_under_the_cursor_are_moved_flipped_and_taken_away) {
  Sections sections({}, 10);
  Sections::Scene scene{.eye = {0, 0, 5}, .under_cursor = std::nullopt, .box = {{0, 0, 0}, {1, 2, 3}}};
  EXPECT_FALSE(sections.take(Command::begin_section, scene).empty()) << "there is nothing under the cursor";
  EXPECT_FALSE(sections.take(Command::flip_section, scene).empty()) << "there is no plane";
  EXPECT_EQ(sections.words(), "");
  scene.under_cursor = Picked{.point = {0, 0, 1}, .normal = {0.01, 0, 0.99995}};
  EXPECT_EQ(sections.take(Command::begin_section, scene), "");
  ASSERT_EQ(sections.section().planes().size(), 1u);
  EXPECT_EQ(sections.section().planes()[0], (SectionPlane{{0, 0, -1}, -1}))
      << "what the surface hides is kept";
  EXPECT_EQ(sections.words(), "cut by 1 plane");
  sections.move(5, scene.eye);
  EXPECT_NEAR(sections.section().planes()[0].offset, -1 + 5 * 4.0 / 50, 1e-9);
  sections.take(Command::pull_section, scene);
  EXPECT_LT(sections.section().planes()[0].offset, -1 + 5 * 4.0 / 50);
  sections.take(Command::flip_section, scene);
  EXPECT_EQ(sections.section().planes()[0].normal, glm::dvec3(0, 0, 1));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(sections.take(Command::begin_section, scene), "");
  EXPECT_FALSE(sections.take(Command::begin_section, scene).empty()) << "a seventh";
  sections.take(Command::toggle_section_box, scene);
  ASSERT_TRUE(sections.section().box());
  EXPECT_TRUE(sections.section().box()->contains(scene.box));
  EXPECT_EQ(sections.words(), "cut by 6 planes and a box");
  for (int i = 0; i < 6; ++i) sections.take(Command::delete_section, scene);
  EXPECT_EQ(sections.words(), "cut by a box");
  const Box around = *sections.section().box();
  sections.take(Command::push_section, scene);
  EXPECT_TRUE(around.contains(*sections.section().box()) && sections.section().box() != around)
      << "without planes the box is moved";
  sections.take(Command::delete_section, scene);
  EXPECT_TRUE(sections.section().keeps_all());
  sections.take(Command::toggle_section_box, scene);
  EXPECT_EQ(sections.section().box(), around);
  sections.take(Command::toggle_section_box, scene);
  EXPECT_TRUE(sections.section().keeps_all());
}

TEST(Picker, what_is_near_the_middle_of_the_picture_lies_on_the_line_of_sight) {
  View view{.camera = {.eye = {1, 2, 3}, .target = {1, 2, -7}}, .width = 40, .height = 20};
  set_field_of_view(view.camera, 60, 2);
  const glm::dvec3 place = Picker::place_at(view, 20, 10, 4);
  EXPECT_LT(glm::distance(place, {1, 2, -1}), 1e-12);
  EXPECT_GT(Picker::place_at(view, 30, 10, 4).x, 1) << "columns go to the right";
  EXPECT_LT(Picker::place_at(view, 20, 15, 4).y, 2) << "rows go down";
}

TEST(Tour, goes_home_and_back_again) {
  const Pack& pack = scenes::pack("room");
  const Box box = pack.skeleton().lattice().box(pack.skeleton().scene_nodes.front().box);
  const Walker start = Walker::before(box, 0.01);
  Tour tour(pack, start);
  Input input;
  input.motion.forward = 1;
  input.seconds = 0.5;
  EXPECT_TRUE(tour.take(input, 300, 200));
  const glm::dvec3 walked = tour.walker().eye();
  EXPECT_NE(walked, start.eye());
  EXPECT_TRUE(tour.take(Command::home, 300, 200));
  EXPECT_EQ(tour.walker().eye(), start.eye());
  EXPECT_TRUE(tour.take(Command::back, 300, 200));
  EXPECT_EQ(tour.walker().eye(), walked);
  EXPECT_TRUE(tour.take(Command::back, 300, 200));
  EXPECT_EQ(tour.walker().eye(), start.eye());
  EXPECT_FALSE(tour.take(Command::back, 300, 200)) << "there was no place before";
}

TEST(Tour, names_what_is_clicked_on_and_fits_it_into_the_window) {
  const Pack& pack = scenes::pack("room");
  const Skeleton& skeleton = pack.skeleton();
  const Walker start = Walker::before(skeleton.lattice().box(skeleton.scene_nodes.front().box), 0.01);
  Tour tour(pack, start);
  const FrameState frame{start.view(300, 200), 1};
  tour.saw(frame, select_cut(FrameView(skeleton, frame)).drawables);
  EXPECT_LT(tour.walker().speed(), skeleton.diagonal());
  EXPECT_NE(tour.walker().speed(), start.speed()) << "the speed fits what is seen";
  Input click;
  click.clicked = CursorPlace{150, 100};
  EXPECT_FALSE(tour.take(click, 300, 200));
  ASSERT_FALSE(tour.selected().empty());
  const std::string& text = tour.selected().all().front().text;
  EXPECT_NE(text.find("scene node"), std::string::npos) << text;
  // Fitted in, it takes up more of the window than it did, or the model does.
  EXPECT_TRUE(tour.take(Command::fit, 300, 200));
  const Box box = tour.selected().box();
  const glm::dvec3 centre = (box.lo + box.hi) * 0.5;
  EXPECT_LE(glm::distance(tour.walker().eye(), centre), glm::distance(start.eye(), centre) + 1e-9);
  EXPECT_LT(glm::length(glm::cross(centre - tour.walker().eye(), tour.walker().direction())), 1e-9)
      << "its middle is the picture's";
  click.clicked = CursorPlace{0, 0};
  tour.take(click, 300, 200);
  EXPECT_TRUE(tour.selected().empty()) << "there is nothing in that corner";
}

TEST(Tour, a_camera_that_is_saved_is_the_same_again) {
  for (const bool orthographic : {false, true}) {
    View view{.camera = {.eye = {1, 2, 3}, .target = {4, 1, -5}}, .width = 400, .height = 200};
    set_field_of_view(view.camera, 50, 2);
    if (orthographic) set_orthographic_height(view.camera, 12, 2);
    view.camera.near = 0.25;
    const Path path{{path_frame(view.camera)}};
    const std::filesystem::path file =
        std::filesystem::path(testing::TempDir()) / "triptych_saved_camera.json";
    write_file(file, path_text(path));
    const View again = load_path(file).view(0, 400, 200, 1);
    EXPECT_EQ(again.camera.eye, view.camera.eye);
    EXPECT_EQ(again.camera.target, view.camera.target);
    EXPECT_EQ(again.camera.near, view.camera.near);
    EXPECT_EQ(again.camera.projection, view.camera.projection);
    EXPECT_NEAR(again.camera.top, view.camera.top, 1e-12);
    EXPECT_NEAR(again.camera.right, view.camera.right, 1e-12);
    std::filesystem::remove(file);
  }
}

}  // namespace
}  // namespace triptych
