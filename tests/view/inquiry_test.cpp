// Searches, outlines and words over pictures.
#include "view/inquiry.hpp"

#include "lod/cut.hpp"
#include "lod/frame_view.hpp"
#include "preprocess/build.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "view/edits.hpp"
#include "view/stroke_font.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

/// Three boxes side by side: a door and two walls.
class NamedBoxes : public testing::Test {
 protected:
  NamedBoxes() {
    Model model;
    model.materials.emplace_back();
    SourceObjects& source = model.source_objects;
    for (const std::string name : {"North wall", "Door 7", "South wall"}) {
      const auto id = static_cast<SourceObjectId>(source.objects.size());
      SourceObject object;
      object.name = source.texts.add(name);
      object.type = source.texts.add(name.starts_with("Door") ? "IfcDoor" : "IfcWall");
      source.objects.push_back(object);
      model.meshes.push_back(awkward::box({3.0 * id, 0, 0}, {3.0 * id + 2, 2, 2}));
      model.instances.emplace_back(id, Affine(1), id);
    }
    SourceObject storey;  // in which nothing stands by itself, but a step
    storey.name = source.texts.add("Ground floor");
    source.objects.push_back(storey);
    SourceObject step;
    step.name = source.texts.add("Step");
    step.parent = 3;
    source.objects.push_back(step);
    model.meshes.push_back(awkward::box({9, 0, 0}, {10, 1, 1}));
    model.instances.emplace_back(3, Affine(1), 4);
    const auto file =
        std::filesystem::path(testing::TempDir()) / ("triptych_asked_" + std::to_string(::getpid()) + ".tpk");
    build_pack(std::move(model), {}, file);
    pack.emplace(file);
    std::filesystem::remove(file);
    const Skeleton& skeleton = pack->skeleton();
    tour.emplace(*pack, Walker::before(skeleton.lattice().box(skeleton.scene_nodes[0].box), 0.01));
    inquiry.emplace(*pack, *tour);
    see();
  }

  void see() {
    const FrameState frame{tour->walker().view(400, 300), 1};
    tour->saw(frame, select_cut(FrameView(pack->skeleton(), frame)).drawables);
  }
  size_t lines() { return inquiry->lines(*tour->frame()).size(); }
  bool give(const std::string& typed, std::vector<Command> commands = {}) {
    Input input;
    input.typed = typed;
    input.commands = std::move(commands);
    const bool moved = inquiry->take(input, 400, 300);
    left = input.commands;
    return moved;
  }

  std::optional<Pack> pack;
  std::optional<Tour> tour;
  std::optional<Inquiry> inquiry;
  std::vector<Command> left;
};

TEST_F(NamedBoxes, are_found_by_a_word_one_after_the_other) {
  give("", {Command::search, Command::fit});
  EXPECT_EQ(left, std::vector<Command>{Command::fit}) << "what is not answered is left";
  EXPECT_TRUE(inquiry->reads_text());
  EXPECT_TRUE(inquiry->changed());
  give("WAll");
  EXPECT_NE(inquiry->title().find("search WAll: 2 objects"), std::string::npos) << inquiry->title();
  const glm::dvec3 eye = tour->walker().eye();
  EXPECT_TRUE(give("\n"));
  EXPECT_NE(tour->walker().eye(), eye) << "it is not fitted in";
  EXPECT_EQ(tour->selected().name(), "North wall");
  EXPECT_TRUE(give("\n"));
  EXPECT_EQ(tour->selected().name(), "South wall");
  EXPECT_NE(inquiry->title().find("2 of 2"), std::string::npos) << inquiry->title();
  give("\n");
  EXPECT_EQ(tour->selected().name(), "North wall") << "round and round";
  give("\r");
  EXPECT_EQ(tour->selected().name(), "South wall") << "and back";
  give("\b\b\b\bDoor\n");
  EXPECT_EQ(tour->selected().name(), "Door 7");
  EXPECT_TRUE(inquiry->title().ends_with(": 1 of 1 object")) << inquiry->title();
  give("\b\b\b\bground\n");
  EXPECT_EQ(tour->selected().box().lo.x, 9) << "what is in it shows it";
  give("x");
  EXPECT_FALSE(give("\n")) << "nothing is found";
  give("", {Command::escape});
  EXPECT_TRUE(left.empty());
  EXPECT_FALSE(inquiry->reads_text());
  EXPECT_FALSE(tour->selected().empty()) << "what was found stays selected";
  give("", {Command::escape});
  EXPECT_TRUE(left.empty());
  EXPECT_TRUE(tour->selected().empty());
  give("", {Command::escape});
  EXPECT_EQ(left.size(), 1u) << "and then the walk is over";
}

TEST_F(NamedBoxes, are_outlined_when_they_are_selected) {
  EXPECT_EQ(lines(), 0u);
  tour->selected().set(tour->selector().describe(SourceObjectId{1}));
  EXPECT_TRUE(inquiry->changed());
  const auto edges = [&] {
    const std::vector<ScreenLine> all = inquiry->lines(*tour->frame());
    // Not those of the words, which are flat.
    return std::count_if(all.begin(), all.end(), [](const ScreenLine& line) {
      return line.color == selection_color && line.from.w != 1;
    });
  };
  EXPECT_EQ(edges(), 12) << "the edges of a box";
  EXPECT_FALSE(inquiry->changed());
  tour->selected().toggle(tour->selector().describe(SourceObjectId{0}));
  EXPECT_TRUE(inquiry->changed());
  EXPECT_EQ(edges(), 24) << "of two boxes";
  tour->selected().clear();
  EXPECT_TRUE(inquiry->changed());
  EXPECT_EQ(lines(), 0u);
}

TEST_F(NamedBoxes, are_selected_together_and_added_up) {
  Selected& selected = tour->selected();
  const auto toggle = [&](SourceObjectId object) {
    return selected.toggle(tour->selector().describe(object));
  };
  EXPECT_TRUE(toggle(0));
  EXPECT_EQ(selected.name(), "North wall");
  EXPECT_EQ(selected.sum({}), "12 triangles, 2.000 x 2.000 x 2.000 m");
  EXPECT_TRUE(toggle(2));
  EXPECT_EQ(selected.name(), "2 objects");
  EXPECT_EQ(selected.sum({}), "24 triangles, 8.000 x 2.000 x 2.000 m") << "around both";
  EXPECT_EQ(selected.sum({.z_up = true, .metres = 0.001, .unit = "mm"}),
            "24 triangles, 8000.000 x 2000.000 x 2000.000 mm");
  EXPECT_EQ(selected.objects(), (std::vector<SourceObjectId>{0, 2}));
  EXPECT_EQ(tour->subject(), (Box{{0, 0, 0}, {8, 2, 2}})) << "what F fits";
  EXPECT_TRUE(toggle(3));
  EXPECT_EQ(selected.triangles(), 36u) << "what is in it counts";
  EXPECT_FALSE(toggle(0));
  EXPECT_FALSE(toggle(2));
  EXPECT_EQ(selected.name(), "Ground floor");
  give("", {Command::search});
  give("wall\v");
  EXPECT_EQ(selected.objects(), (std::vector<SourceObjectId>{0, 2})) << "all that were found";
}

TEST_F(NamedBoxes, are_clicked_one_after_the_other) {
  const PictureSpace space(tour->frame()->view);
  const auto click = [&](const glm::dvec3& at, bool adds) {
    Input input;
    const glm::dvec2 pixel = space.pixel(space.from_eye(at));
    input.clicked = CursorPlace{pixel.x, pixel.y};
    input.click_adds = adds;
    tour->take(input, 400, 300);
    return tour->selected().name();
  };
  EXPECT_EQ(click({1, 1, 2}, true), "North wall");
  EXPECT_EQ(click({4, 1, 2}, true), "2 objects");
  EXPECT_EQ(click({1, 1, 2}, true), "Door 7") << "once more takes it away";
  EXPECT_EQ(click({7, 1, 2}, true), "2 objects");
  EXPECT_EQ(click({-90, 90, 2}, true), "2 objects") << "a miss is no new beginning";
  EXPECT_EQ(click({1, 1, 2}, false), "North wall");
  EXPECT_EQ(click({-90, 90, 2}, false), "");
}

TEST_F(NamedBoxes, are_hidden_and_cut_in_one_history) {
  Edits edits(pack->skeleton(), {}, {});
  const auto take = [&](Command command) { return edits.take(command, *tour, {}); };
  EXPECT_EQ(take(Command::undo), "nothing to undo");
  EXPECT_NE(take(Command::hide_object), "") << "nothing is selected";
  EXPECT_EQ(take(Command::undo), "nothing to undo") << "what changed nothing is no step";
  tour->selected().set(tour->selector().describe(SourceObjectId{0}));
  tour->selected().toggle(tour->selector().describe(SourceObjectId{1}));
  EXPECT_EQ(take(Command::hide_object), "");
  EXPECT_EQ(edits.hiding().name.count, 2u);
  EXPECT_EQ(take(Command::toggle_section_box), "");
  const Section with_box = edits.section();
  ASSERT_TRUE(with_box.box());
  EXPECT_TRUE(with_box.box()->contains(Box{{0, 0, 0}, {5, 2, 2}}));
  EXPECT_FALSE(with_box.box()->contains(Box{{0, 0, 0}, {6, 2, 2}}));
  edits.move(1, {0, 0, 9});
  edits.move(1, {0, 0, 9});
  EXPECT_TRUE(with_box.box()->contains(*edits.section().box())) << "it gets smaller";
  const Section moved = edits.section();
  EXPECT_EQ(take(Command::show_all), "");
  EXPECT_EQ(edits.hiding().name.count, 0u);
  take(Command::undo);
  EXPECT_EQ(edits.hiding().name.count, 2u);
  EXPECT_EQ(edits.section(), moved);
  take(Command::undo);
  if (edits.section() != with_box) take(Command::undo);  // a machine that was slow between the two moves
  EXPECT_EQ(edits.section(), with_box);
  take(Command::undo);
  EXPECT_TRUE(edits.section().keeps_all());
  EXPECT_EQ(edits.hiding().name.count, 2u);
  take(Command::undo);
  EXPECT_EQ(edits.hiding().name.count, 0u);
  EXPECT_EQ(take(Command::undo), "nothing to undo");
  take(Command::redo);
  take(Command::redo);
  EXPECT_EQ(edits.section(), with_box);
  EXPECT_EQ(edits.hiding().name.count, 2u);
  tour->selected().set(tour->selector().describe(SourceObjectId{2}));
  take(Command::toggle_section_box);
  EXPECT_TRUE(edits.section().box() && edits.section() != with_box) << "of what is selected now";
  EXPECT_EQ(take(Command::redo), "nothing to redo") << "after something else";
  take(Command::toggle_section_box);
  EXPECT_TRUE(edits.section().keeps_all()) << "the same again: no box";
}

TEST_F(NamedBoxes, are_measured_by_clicks_until_escape) {
  give("", {Command::measure});
  EXPECT_EQ(inquiry->title(), "measuring: click a point");
  const PictureSpace space(tour->frame()->view);
  const auto click = [&](const glm::dvec3& at) {
    Input input;
    const glm::dvec2 pixel = space.pixel(space.from_eye(at));
    input.clicked = input.cursor = CursorPlace{pixel.x + 1, pixel.y - 1};
    inquiry->take(input, 400, 300);
    EXPECT_FALSE(input.clicked) << "a point is no selection";
  };
  click({0, 2, 2});
  click({2, 2, 2});
  EXPECT_NE(inquiry->title().find("distance 2.000 m"), std::string::npos) << inquiry->title();
  EXPECT_TRUE(tour->selected().empty());
  EXPECT_GT(lines(), 20u) << "with its number";
  give("", {Command::back});
  EXPECT_TRUE(left.empty()) << "Backspace takes a point back";
  EXPECT_EQ(inquiry->title().find("distance"), std::string::npos);
  give("", {Command::escape});
  EXPECT_TRUE(left.empty()) << "Esc ends measuring, not the walk";
  EXPECT_EQ(lines(), 0u);
}

TEST(StrokeFont, has_a_picture_of_its_own_for_each_letter) {
  std::vector<std::vector<Stroke>> seen;
  for (char letter = '!'; letter <= '~'; ++letter) {
    const std::vector<Stroke> strokes = strokes_of(std::string(1, letter));
    ASSERT_FALSE(strokes.empty()) << letter;
    for (const auto& [from, to] : strokes) {
      for (const glm::dvec2& place : {from, to}) {
        EXPECT_TRUE(place.x >= 0 && place.x <= 4 && place.y >= 0 && place.y <= 9) << letter;
      }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), strokes), 0) << letter;
    seen.push_back(strokes);
  }
  EXPECT_TRUE(strokes_of(" ").empty());
  EXPECT_EQ(text_width("ü²x"), 3 * font_advance) << "letters, not bytes";
  EXPECT_GT(strokes_of("ü").size(), strokes_of("u").size());
  EXPECT_EQ(strokes_of("\xff"), strokes_of("\xe6\xbc\xa2")) << "a box for what it has not";
}

TEST_F(NamedBoxes, are_fitted_in_where_they_can_be_seen) {
  // The door stands between the walls: from a place beside them a wall hides it.
  Camera beside = tour->walker().view(400, 300).camera;
  beside.eye = {-20, 1, 1};
  beside.target = {4, 1, 1};
  beside.up = {0, 1, 0};
  for (const bool orthographic : {false, true}) {
    tour->jump_to(beside);
    if (orthographic) tour->take(Command::switch_projection, 400, 300);
    see();
    tour->selected().set(tour->selector().describe(SourceObjectId{1}));
    EXPECT_TRUE(tour->take(Command::fit, 400, 300));
    see();
    const auto seen = tour->under({200, 150});
    ASSERT_TRUE(seen);
    EXPECT_GE(seen->point.x, 3 - 1e-6) << "a wall is before it";
    EXPECT_LE(seen->point.x, 5 + 1e-6);
    if (orthographic) {
      EXPECT_NEAR(tour->walker().direction().x, 1, 1e-9) << "the direction stays";
    } else {
      EXPECT_LT(tour->walker().direction().x, 0.9);
    }
    if (orthographic) tour->take(Command::switch_projection, 400, 300);
  }
  // From a side that was asked for one does not turn, and stands before the wall.
  tour->jump_to(beside);
  see();
  tour->take(Command::look_at_right, 400, 300);
  EXPECT_NEAR(tour->walker().direction().x, -1, 1e-9);
  EXPECT_GT(tour->walker().eye().x, 5);
  EXPECT_LT(tour->walker().eye().x, 6);
  // Where nothing is in the way, it is as ever.
  beside.eye = {4, 1, 30};
  tour->jump_to(beside);
  Walker plain = tour->walker();
  see();
  tour->take(Command::fit, 400, 300);
  plain.frame(tour->subject(), 4.0 / 3);
  EXPECT_NEAR(glm::distance(plain.eye(), tour->walker().eye()), 0, 1e-9);
}

TEST_F(NamedBoxes, that_hardly_show_elsewhere_are_fitted_in_without_turning) {
  // Between the door and the first wall, which is where the eye would be for all of the door to fit in.
  Camera between = tour->walker().view(400, 300).camera;
  between.eye = {2.1, 1, 1};
  between.target = {4, 1, 1};
  between.up = {0, 1, 0};
  tour->jump_to(between);
  see();
  tour->selected().set(tour->selector().describe(SourceObjectId{1}));
  tour->take(Command::fit, 400, 300);
  see();
  EXPECT_LT(tour->walker().direction().x, 0.9) << "half of the way is clear: one turns";
  // With a long lens the wall is so near that nothing of the door would show: one stands behind it.
  set_field_of_view(between, 4, 4.0 / 3);
  tour->jump_to(between);
  see();
  Walker plain = tour->walker();
  plain.look_at(Side::right);
  plain.frame(tour->subject(), 4.0 / 3);
  tour->take(Command::look_at_right, 400, 300);
  EXPECT_NEAR(glm::distance(plain.eye(), tour->walker().eye()), 0, 1e-9);
  EXPECT_GT(tour->walker().eye().x, 9);
}

TEST_F(NamedBoxes, in_an_orthographic_picture_from_inside_are_not_hidden_by_what_is_behind_the_eye) {
  Camera inside = tour->walker().view(400, 300).camera;
  inside.eye = {2.5, 1, 1};  // between the first wall and the door
  inside.target = {4, 1, 1};
  inside.up = {0, 1, 0};
  tour->jump_to(inside);
  see();
  ASSERT_NEAR(tour->under({200, 150})->point.x, 3, 1e-6);
  tour->take(Command::switch_projection, 400, 300);
  see();
  EXPECT_NEAR(tour->under({200, 150})->point.x, 3, 1e-6);
}

TEST(Overlay, cuts_off_what_lies_before_the_near_plane) {
  for (const bool orthographic : {false, true}) {
    View view{.camera = {.eye = {0, 0, 0}, .target = {0, 0, -1}}, .width = 100, .height = 100};
    set_field_of_view(view.camera, 90, 1);
    if (orthographic) set_orthographic_height(view.camera, 2, 1);
    view.camera.near = 0.5;
    ScreenLines lines(view);
    lines.add_line({0, 0, -10}, {0, 0, 10}, word_color);
    const ScreenLine& line = lines.lines().front();
    EXPECT_TRUE(line.from.z >= 0 && line.from.z <= line.from.w);
    EXPECT_GT(line.to.z, line.to.w) << "it is behind the eye";
    // Where it is cut: at the near plane.
    const float from = line.from.w - line.from.z, to = line.to.w - line.to.z;
    EXPECT_NEAR(from / (from - to), 9.5 / 20, 1e-5);
    Overlay overlay(view);
    overlay.square({0, 0, 1}, word_color);
    overlay.label({0, 0, -0.2}, {{"near"}});
    overlay.label({9, 0, -1}, {{"beside the picture"}});
    EXPECT_TRUE(overlay.lines().empty());
  }
}

}  // namespace
}  // namespace triptych
