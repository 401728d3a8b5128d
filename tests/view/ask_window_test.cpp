// What a person asks of the model in a real window: measures, searches, viewpoints; and what becomes of a
// person whose render node is killed.
#include "tests/view/view_window.hpp"

#include <cstdio>

namespace triptych::test {
namespace {

class AskingWindow : public ViewWindow {
 protected:
  std::vector<std::string> asked(const std::string& size = "480x360") const {
    return {"view", pack, "--size", size, "-o", folder.file("pictures")};
  }
  bool title_has(const std::string& words) const {
    for (int tries = 0; tries < 1000; ++tries) {
      if (title().find(words) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  static bool said(const Program& program, const std::string& words) {
    for (int tries = 0; tries < 3000 && program.errors().find(words) == std::string::npos; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return program.errors().find(words) != std::string::npos;
  }
};

TEST_F(AskingWindow, measures_between_clicks_and_shows_it_until_escape) {
  Program program(asked());
  find_window();
  const Picture before = look();
  xdotool("key m");
  EXPECT_TRUE(title_has("measuring: click a point")) << title();
  xdotool("mousemove 240 180 sleep 0.3 click 1 sleep 0.3");
  EXPECT_TRUE(title_has("x ")) << title();
  xdotool("mousemove 300 200 sleep 0.3 click 1 sleep 0.3");
  EXPECT_TRUE(title_has("distance ")) << title();
  EXPECT_NE(program.errors().find("point 2: x "), std::string::npos) << program.errors();
  const Picture measured = look();
  EXPECT_NE(measured, before) << "nothing is drawn of it";
  xdotool("mousemove 240 240 sleep 0.3 click 1 sleep 0.3");
  EXPECT_TRUE(title_has("angle ")) << title();
  xdotool("key BackSpace");
  EXPECT_TRUE(title_has("distance ")) << title();
  xdotool("key Escape sleep 0.3");
  EXPECT_EQ(title().find("distance "), std::string::npos) << title();
  EXPECT_EQ(look(), before) << "something is left of it";
  leave(program);
}

TEST_F(AskingWindow, outlines_what_is_selected_until_the_background_is_clicked) {
  Program program(asked());
  find_window();
  const Picture before = look();
  click(240, 180);
  EXPECT_TRUE(title_has(", drawable "));
  const Picture outlined = look();
  EXPECT_NE(outlined, before);
  click(2, 2);
  EXPECT_EQ(look(), before);
  click(240, 180);
  EXPECT_EQ(look(), outlined);
  xdotool("key Escape sleep 0.3");
  EXPECT_EQ(look(), before) << "Esc leaves nothing selected";
  leave(program);
}

TEST_F(AskingWindow, reads_words_and_not_commands_while_it_searches) {
  Program program(asked());
  find_window();
  const Picture before = look();
  xdotool("key slash sleep 0.2 type wall");
  EXPECT_TRUE(title_has("search wall: 0 objects")) << title() << " (the scene names none)";
  xdotool("key BackSpace key BackSpace");
  EXPECT_TRUE(title_has("search wa: ")) << title();
  xdotool("key Escape sleep 0.3");
  EXPECT_EQ(look(), before) << "W and A have moved the eye, or the word is still there";
  xdotool("key ctrl+f sleep 0.2 type é");
  EXPECT_TRUE(title_has("search é")) << title();
  leave(program, 2);
}

TEST_F(AskingWindow, saves_viewpoints_that_show_the_same_again) {
  std::string saved = folder.file("pictures/viewpoint-000.bcfzip");
  {
    Program program(asked());
    find_window();
    xdotool("keydown w sleep 0.3 keyup w sleep 0.3 key F5");
    EXPECT_TRUE(title_has("saved viewpoint-000.bcfzip")) << title();
    const Picture walked = look();
    leave(program);
    run({"render", pack, "--bcf", saved, "--size", "480x360", "-o", folder.file("again")});
    // The camera goes through decimal numbers and another direction's length: hardly any pixel is another.
    const Picture again = read_picture(folder.file("again/000000.png"));
    ASSERT_EQ(again.rgb.size(), walked.rgb.size());
    size_t others = 0;
    for (size_t i = 0; i < again.rgb.size(); i += 3) others += again.rgb[i] != walked.rgb[i];
    EXPECT_LT(others, again.rgb.size() / 3 / 500);
  }
  looks = 0;
  std::filesystem::remove(folder.file("pictures/picture-000.png"));
  Program program(with(asked(), {"--bcf", saved}));
  find_window();
  EXPECT_EQ(look(), read_picture(folder.file("again/000000.png")));
  leave(program);
  EXPECT_NE(failure(with(asked(), {"--bcf", saved, "--viewpoint", "2"})).find("has 1 viewpoints"),
            std::string::npos);
  EXPECT_NE(failure({"render", pack, "--bcf", path, "-o", folder.file("none")}).find("is not a zip archive"),
            std::string::npos);
}

TEST_F(AskingWindow, copies_its_camera_and_takes_one) {
  Program program(asked());
  find_window();
  const Picture before = look();
  xdotool("key ctrl+c sleep 0.2 keydown w sleep 0.3 keyup w sleep 0.3");
  EXPECT_NE(look(), before);
  xdotool("key ctrl+v sleep 0.3");
  EXPECT_EQ(look(), before);
  EXPECT_NE(title().find("culling on"), std::string::npos) << "Ctrl+C is not C";
  leave(program);
}

TEST_F(AskingWindow, of_a_session_says_that_a_role_is_gone_and_that_it_is_back) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--gather", "60", "--restarts", "2"});
  find_window();
  ASSERT_TRUE(said(program, "both switch nodes are here")) << program.errors();
  EXPECT_EQ(title().find("alone"), std::string::npos) << title();
  const pid_t hung = program.role("switch 1");
  ::kill(hung, SIGSTOP);
  xdotool("keydown w sleep 0.3 keyup w");
  EXPECT_TRUE(title_has("switch node 1 is gone: drawing alone")) << title();
  ::kill(hung, SIGKILL);
  EXPECT_TRUE(said(program, "both switch nodes are back")) << program.errors();
  for (int tries = 0; tries < 500 && title().find("alone") != std::string::npos; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(title().find("alone"), std::string::npos) << title();
  leave(program);
}

TEST_F(AskingWindow, of_a_session_stands_where_the_person_stood_when_the_render_node_is_killed) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--gather", "60", "-o", folder.file("pictures")});
  find_window();
  ASSERT_TRUE(said(program, "both switch nodes are here")) << program.errors();
  const Picture start = look();
  xdotool("keydown w sleep 0.4 keyup w keydown a sleep 0.2 keyup a sleep 0.2 key l sleep 0.8");
  const Picture walked = look();
  EXPECT_NE(walked, start);
  kill_render_node(program);
  EXPECT_EQ(look(), walked) << "the new one stands elsewhere";
  leave(program);
  EXPECT_FALSE(program.anybody_left());
}

}  // namespace
}  // namespace triptych::test
