// Hiding at a real window: what a person clicks on is gone, with its layer or storey, and comes back.
#include "tests/view/view_window.hpp"

namespace triptych::test {
namespace {

class HidingWindow : public ViewWindow {
 protected:
  HidingWindow() { scenes::write_pack_with_objects("room", pack); }

  /// Presses a key and says what there is to be seen, which must be the same without culling.
  Picture after(const std::string& key) {
    xdotool("key " + key + " sleep 0.1");
    const Picture culled = look();
    xdotool("key c");
    EXPECT_EQ(look(), culled) << key << ": the culled picture is not the un-culled one";
    xdotool("key c");
    return culled;
  }
  /// How many objects are hidden, as the title has it.
  size_t hidden() const {
    const std::string text = title();
    const size_t end =
        text.find(text.find(" objects hidden") == std::string::npos ? " object hidden" : " objects hidden");
    if (end == std::string::npos) return 0;
    return std::stoul(text.substr(text.rfind(' ', end - 1)));
  }
  void click_in_the_middle() {
    click(160, 120);
    EXPECT_NE(title().find(", object "), std::string::npos) << title();
  }
};

TEST_F(HidingWindow, hides_and_isolates_what_is_selected_and_shows_it_again) {
  Program program(view({"--json", json}));
  find_window();
  const Picture untouched = look();
  xdotool("key h sleep 0.2");
  EXPECT_NE(title().find("no object is selected"), std::string::npos) << title();
  EXPECT_EQ(look(), untouched);
  click_in_the_middle();
  const Picture first = look();  // with the outline of what is selected
  const Picture without = after("h");
  EXPECT_NE(without, first) << "H hides nothing";
  EXPECT_GE(hidden(), 1u) << title();
  EXPECT_LE(hidden(), 2u) << title();
  EXPECT_EQ(after("ctrl+z"), first) << "Ctrl+Z does not bring it back";
  EXPECT_EQ(hidden(), 0u) << title();
  const Picture alone = after("i");
  EXPECT_NE(alone, first);
  EXPECT_NE(alone, without);
  EXPECT_GT(colors_in(alone), 1u) << "what is isolated does not show";
  EXPECT_GT(hidden(), 10u) << title();
  EXPECT_EQ(after("u"), first) << "U does not show all";
  EXPECT_EQ(after("ctrl+z"), alone) << "Ctrl+Z does not undo that";
  leave(program, 2);
  EXPECT_GT(json_of(json).at("hidden_objects").get<int>(), 10);
}

TEST_F(HidingWindow, hides_layers_and_storeys_and_knows_no_file_of_a_model_of_one) {
  Program program(view());
  find_window();
  click_in_the_middle();
  const Picture first = look();  // with the outline of what is selected
  const Picture without_layer = after("ctrl+h");
  const size_t layer = hidden();
  EXPECT_NE(without_layer, first);
  EXPECT_GT(layer, 2u) << title();
  EXPECT_NE(after("alt+h"), without_layer) << "Alt+H hides no storey";
  EXPECT_GT(hidden(), layer) << title();
  EXPECT_EQ(after("ctrl+z"), without_layer);
  const Picture of_layer = after("ctrl+i");
  const size_t others = hidden();
  EXPECT_NE(of_layer, first);
  EXPECT_NE(after("alt+i"), of_layer);
  EXPECT_LT(hidden(), others) << "there are fewer storeys than layers: " << title();
  xdotool("key u key ctrl+alt+h sleep 0.2");
  EXPECT_NE(title().find("the model is of one file"), std::string::npos) << title();
  EXPECT_EQ(look(), first);
  leave(program, 2);
}

TEST_F(HidingWindow, begins_with_what_the_command_line_hides) {
  Program program(view({"--isolate", "layer:layer 1"}));
  find_window();
  const Picture some = look();
  EXPECT_GT(hidden(), 10u) << title();
  run({"render", pack, "--path", path, "--size", "320x240", "--frames", "1", "--isolate", "layer:layer 1",
       "-o", folder.file("rendered")});
  EXPECT_EQ(read_picture(folder.file("rendered/000000.png")), some);
  EXPECT_NE(after("u"), some);
  leave(program, 2);
}

TEST_F(HidingWindow, of_a_session_tells_the_switch_nodes_and_the_recording) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json, "--hash",
                   "--record", folder.file("recording"), "--gather", "60"});
  find_window();
  click_in_the_middle();
  for (const std::string key : {"h", "ctrl+h", "ctrl+z", "alt+i", "u", "i"}) {
    xdotool("key " + key + " sleep 0.2 keydown w sleep 0.1 keyup w sleep 0.2");
    EXPECT_EQ(hidden() == 0, key == "u") << title();
  }
  xdotool("key Escape sleep 0.3 key Escape");
  const nlohmann::json report = whole_session(program);
  const std::string replayed = folder.file("replayed.json");
  run({"replay", folder.file("recording"), "--frames", "all", "-o", folder.file("replayed"), "--json",
       replayed});
  const nlohmann::json frames = json_of(replayed).at("frames");
  ASSERT_EQ(frames.size(), report.at("pictures").size());
  size_t with_hidden = 0;
  for (size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].at("picture_hash"), report.at("pictures")[i]) << i;
    with_hidden += frames[i].at("hidden").get<size_t>() > 0;
  }
  EXPECT_GT(with_hidden, 5u);
  EXPECT_LT(with_hidden, frames.size());
}

TEST_F(HidingWindow, of_a_session_keeps_what_is_hidden_and_cut_when_the_render_node_is_killed) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--gather", "60", "-o", folder.file("pictures")});
  find_window();
  const Picture whole = look();
  click_in_the_middle();
  xdotool("key h sleep 0.3 mousemove 160 120 sleep 0.2 key x key Prior key Prior sleep 0.8");
  const size_t gone = hidden();
  EXPECT_GT(gone, 0u) << title();
  EXPECT_NE(title().find("cut by 1 plane"), std::string::npos) << title();
  const Picture left = look();
  EXPECT_NE(left, whole);
  kill_render_node(program);
  EXPECT_EQ(look(), left);
  EXPECT_EQ(hidden(), gone) << title();
  EXPECT_NE(title().find("cut by 1 plane"), std::string::npos) << title();
  leave(program, 2);
}

}  // namespace
}  // namespace triptych::test
