// Several selected objects, cuts and hiding step by step, and what a session's window begins with and keeps,
// at a real window.
#include "preprocess/build.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/view/view_window.hpp"

namespace triptych::test {
namespace {

class EditWindow : public ViewWindow {
 protected:
  EditWindow() { scenes::write_pack_with_objects("room", pack); }

  Picture after(const std::string& keys) {
    xdotool(keys + " sleep 0.2");
    return look();
  }
  /// Of the places of the picture's middle row and column, Ctrl+clicks those that it takes to select two
  /// objects.
  void select_two() const {
    click(160, 120);
    for (int i = 1; i < 8 && title().find(", 2 objects") == std::string::npos; ++i) {
      click(160 + i * 18 * (i % 2 == 0 ? 1 : -1), 120 + i * 9, "ctrl");
    }
    EXPECT_TRUE(title_has("2 objects")) << title();
  }
};

TEST_F(EditWindow, undoes_and_redoes_cuts_and_hiding_in_their_order) {
  Program program(view());
  find_window();
  click(160, 120);
  const Picture first = look();
  const Picture hidden = after("key h");
  EXPECT_NE(hidden, first);
  const Picture cut = after("mousemove 160 120 sleep 0.1 key x");
  EXPECT_TRUE(title_has("cut by 1 plane")) << title();
  const Picture pushed = after("key Prior");
  EXPECT_NE(pushed, cut) << "the cut does not move";
  const Picture flipped = after("key z");
  EXPECT_NE(flipped, pushed);
  const Picture shown = after("key u");
  EXPECT_NE(shown, flipped);
  for (const Picture* before : {&flipped, &pushed, &cut, &hidden, &first})
    EXPECT_EQ(after("key ctrl+z"), *before) << "of five steps back";
  xdotool("key ctrl+z sleep 0.2");
  EXPECT_TRUE(title_has("nothing to undo")) << title();
  EXPECT_EQ(after("key ctrl+y"), hidden);
  EXPECT_EQ(after("key ctrl+shift+z"), cut) << "and the eye has not gone down with Shift";
  xdotool("key ctrl+y key ctrl+y key ctrl+y sleep 0.2");
  EXPECT_EQ(look(), shown);
  xdotool("key ctrl+y sleep 0.2");
  EXPECT_TRUE(title_has("nothing to redo")) << title();
  leave(program, 2);
}

TEST_F(EditWindow, selects_several_objects_and_hides_isolates_and_cuts_to_all_of_them) {
  Program program(view({"--json", json}));
  find_window();
  click(160, 120);
  const Picture one = look();
  click(267, 190, "ctrl");  // not the wall, whose box would hold all that shows
  EXPECT_TRUE(title_has("2 objects")) << title();
  const Picture two = look();
  EXPECT_NE(two, one) << "the second has no outline, and there is no sum";
  const Picture without = after("key h");
  EXPECT_TRUE(title_has(" objects hidden")) << title();
  EXPECT_NE(without, two);
  EXPECT_EQ(after("key ctrl+z"), two);
  const Picture alone = after("key i");
  EXPECT_NE(alone, two);
  EXPECT_GT(colors_in(alone), 1u);
  EXPECT_EQ(after("key ctrl+z"), two);
  const Picture boxed = after("key k");
  EXPECT_TRUE(title_has("cut by a box")) << title();
  EXPECT_NE(boxed, two);
  EXPECT_EQ(after("key k"), two) << "the same again: no box";
  const Picture fitted = after("key f");
  EXPECT_NE(fitted, two);
  leave(program, 2);
}

TEST_F(EditWindow, says_how_many_of_the_parts_that_are_cut_are_open) {
  std::vector<Mesh> boxes;
  for (const double x : {0, 2, 4}) boxes.push_back(awkward::box({x, 0, 0}, {x + 1, x + 2, 1}));
  boxes[1].triangles.pop_back();
  boxes[2].triangles.pop_back();
  build_pack(awkward::model_of(boxes), {.part_triangles = 64, .leaf_triangles = 12}, pack);
  Program program({"view", pack, "--size", "320x240", "--section", "y<1", "-o", folder.file("pictures")});
  find_window();
  EXPECT_TRUE(title_has(", cut by 1 plane (2 cut parts are open)")) << title();
  xdotool("key Delete sleep 0.3");
  EXPECT_EQ(title().find("open"), std::string::npos) << title();
  leave(program);
  for (const auto& [plane, words] :
       {std::pair{"y<5", ", cut by 1 plane (1 cut part is open)"}, {"x<0.5", ", cut by 1 plane"}}) {
    Program other({"view", pack, "--size", "320x240", "--section", plane, "-o", folder.file("others")});
    find_window();
    EXPECT_TRUE(title().ends_with(words)) << title();
    leave(other);
  }
}

TEST_F(EditWindow, shows_its_help_over_the_picture_until_escape) {
  Program program({"view", pack, "--size", "800x600", "-o", folder.file("pictures")});
  find_window();
  const Picture before = look();
  const Picture helping = after("key F1");
  EXPECT_NE(helping, before);
  EXPECT_EQ(after("key F1"), before);
  EXPECT_EQ(after("key F1"), helping);
  EXPECT_EQ(after("key Escape"), before);
  leave(program);
}

TEST_F(EditWindow, shows_its_help_page_by_page_where_the_window_is_small) {
  Program program({"view", pack, "--size", "400x300", "-o", folder.file("pictures")});
  find_window();
  const Picture before = look();
  std::vector<Picture> pages;
  for (int i = 0; i < 9; ++i) {
    const Picture page = after("key F1");
    if (page == before) break;
    for (const Picture& other : pages) EXPECT_NE(page, other);
    pages.push_back(page);
  }
  EXPECT_GT(pages.size(), 1u);
  EXPECT_LT(pages.size(), 5u);
  EXPECT_EQ(after("key F1"), pages.front());
  EXPECT_EQ(after("key Escape"), before);
  leave(program);
}

TEST_F(EditWindow, finds_all_objects_of_a_word_and_fits_them) {
  Program program(view());
  find_window();
  const Picture before = look();
  xdotool("key slash sleep 0.2 type layer");
  EXPECT_TRUE(title_has("search layer: ")) << title();
  xdotool("key ctrl+Return sleep 0.3 key Escape sleep 0.3");
  EXPECT_TRUE(title_has(" objects,") || title_has(" objects")) << title();
  EXPECT_NE(look(), before);
  leave(program, 2);
}

TEST_F(EditWindow, of_a_session_keeps_selection_and_measurements_when_the_render_node_is_killed) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--gather", "60", "-o", folder.file("pictures")});
  find_window();
  const Picture untouched = look();
  select_two();
  const Picture selected = look();
  xdotool("key m sleep 0.2");
  click(160, 120);
  click(190, 150);
  EXPECT_TRUE(title_has("distance ")) << title();
  xdotool("key m sleep 0.2");
  click(130, 140);
  click(140, 100);
  const std::string all = title(), distance = all.substr(0, all.find(", dx")).substr(all.find("distance "));
  xdotool("mousemove 2 2 sleep 0.5");
  const Picture measured = look();
  EXPECT_NE(measured, selected);
  kill_render_node(program);
  xdotool("mousemove 3 3 sleep 0.2 mousemove 2 2 sleep 0.5");
  EXPECT_EQ(look(), measured);
  EXPECT_NE(title().find(distance), std::string::npos) << title();
  EXPECT_TRUE(title_has("2 objects")) << title();
  xdotool("key Escape sleep 0.3");
  EXPECT_EQ(look(), selected) << "Esc ends measuring";
  xdotool("key Escape sleep 0.3");
  EXPECT_EQ(look(), untouched) << "and then nothing is selected";
  leave(program);
}

TEST_F(EditWindow, of_a_session_snaps_to_what_is_under_the_cursor_when_the_render_node_is_killed) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--gather", "60", "-o", folder.file("pictures")});
  find_window();
  xdotool("mousemove 160 120 sleep 0.2");
  const Picture before = look();
  const Picture snapped = after("key m sleep 0.3");
  EXPECT_NE(snapped, before) << "no mark under the cursor";
  kill_render_node(program);
  Picture again = look();
  for (int tries = 0; tries < 50 && again != snapped; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    again = look();
  }
  EXPECT_EQ(again, snapped) << "and the mouse did not move";
  leave(program, 2);
}

TEST_F(EditWindow, of_a_session_begins_at_a_viewpoint_and_saves_others) {
  const std::string saved = folder.file("pictures/viewpoint-000.bcfzip");
  {
    Program program(view());
    find_window();
    xdotool("key w sleep 0.3");  // BCF has no off-axis cameras, as the path begins with
    click(160, 120);
    xdotool("key h sleep 0.3 mousemove 200 150 sleep 0.2 key x sleep 0.2 key k sleep 0.2 key F5");
    EXPECT_TRUE(title_has("cut by 1 plane and a box")) << title();
    EXPECT_TRUE(title_has("saved viewpoint-000.bcfzip")) << title() << "\n" << program.errors();
    leave(program, 2);
  }
  Program program({"session", pack, "--window", "--bcf", saved, "--size", "320x240", "--json", json,
                   "--gather", "60", "-o", folder.file("session")});
  find_window();
  EXPECT_TRUE(title_has("cut by 1 plane and a box")) << title();
  xdotool("key k sleep 0.3");
  EXPECT_TRUE(title_has("cut by 1 plane")) << title();
  EXPECT_EQ(title().find("a box"), std::string::npos) << "the same box again is none: " << title();
  xdotool("key k sleep 0.3");
  EXPECT_TRUE(title_has("cut by 1 plane and a box")) << title();
  xdotool("key F5 sleep 0.2 key F3 sleep 0.2");
  for (const char* const file : {"session/viewpoint-000.bcfzip", "session/camera-000.json"}) {
    for (int tries = 0; tries < 500 && !std::filesystem::exists(folder.file(file)); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(std::filesystem::exists(folder.file(file))) << file;
  }
  leave(program);
  EXPECT_NE(
      failure({"session", pack, "--window", "--bcf", saved, "--viewpoint", "2"}).find("has 1 viewpoints"),
      std::string::npos);
  EXPECT_NE(failure({"session", pack, "--window", "--bcf", path}).find("is not a zip archive"),
            std::string::npos);
  Program without_a_window({"session", pack, "--bcf", saved});
  EXPECT_EQ(without_a_window.wait(), 2) << without_a_window.errors();
}

}  // namespace
}  // namespace triptych::test
