// The program's window as a person has it before them: keys, mouse, size, and what is to be seen then.
#include "tests/session/hosts_file.hpp"
#include "tests/view/view_window.hpp"

#include <cmath>
#include <numbers>

namespace triptych::test {
namespace {

TEST_F(ViewWindow, shows_what_a_person_does_and_culling_changes_no_pixel) {
  Program program(view({"--json", json}));
  find_window();
  const Picture first = look();
  EXPECT_EQ(first.width, 320u);
  EXPECT_EQ(first.height, 240u);
  EXPECT_GT(colors_in(first), 2u);
  EXPECT_NE(title().find("culling on"), std::string::npos) << title();

  xdotool("keydown w sleep 0.3 keyup w");
  const Picture walked = look();
  EXPECT_NE(walked, first) << "W does not move the eye";
  xdotool("mousemove 100 100 sleep 0.2 mousedown 1 sleep 0.3 mousemove 160 120 sleep 0.3 mouseup 1");
  const Picture turned = look();
  EXPECT_NE(turned, walked) << "the mouse does not turn the eye";
  xdotool("mousemove 40 40");
  EXPECT_EQ(look(), turned) << "the mouse turns the eye without its button";

  xdotool("key c");
  EXPECT_EQ(look(), turned) << "the culled picture is not the un-culled one";
  EXPECT_NE(title().find("culling off"), std::string::npos) << title();
  xdotool("key c key b");
  const Picture from_above = look();
  EXPECT_NE(from_above, turned);
  EXPECT_GT(colors_in(from_above), 2u);
  xdotool("key b");
  EXPECT_EQ(look(), turned);
  xdotool("key F1 sleep 0.2 key Escape sleep 0.2");
  EXPECT_EQ(look(), turned) << "Esc does not end the help";
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  EXPECT_NE(program.errors().find("bird's-eye"), std::string::npos) << "F1 prints no help";
  EXPECT_GE(json_of(json).at("frames").get<int>(), looks);
}

TEST_F(ViewWindow, says_to_which_pixel_error_a_target_of_time_raises_frames) {
  Program program(view({"--json", json, "--target-ms", "0.000001"}));  // which nothing keeps
  find_window();
  EXPECT_NE(title().find("64 px (asked for 1)"), std::string::npos) << title();
  const Picture raised = look();
  EXPECT_GT(colors_in(raised), 2u);
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report.at("steering").at("out_of_reach_frames"), report.at("frames"));

  Program with_time(view({"--json", json, "--target-ms", "1000000"}));
  find_window();
  EXPECT_NE(title().find(" 1 px,"), std::string::npos) << title();
  xdotool("key Escape");
  EXPECT_EQ(with_time.wait(std::chrono::seconds(60)), 0) << with_time.errors();
  EXPECT_EQ(json_of(json).at("steering").at("raised_frames"), 0);
}

TEST_F(ViewWindow, draws_in_the_size_that_the_window_has) {
  Program program(view());
  find_window();
  xdotool("windowsize --sync " + window + " 400 200");
  Picture picture;
  for (int tries = 0; tries < 20 && picture.width != 400; ++tries) picture = look();
  EXPECT_EQ(picture.width, 400u);
  EXPECT_EQ(picture.height, 200u);
  EXPECT_GT(colors_in(picture), 2u);
  xdotool("key c");
  EXPECT_EQ(look(), picture);
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
}

TEST_F(ViewWindow, looks_at_the_model_from_outside_where_there_is_no_path) {
  Program program({"view", pack, "--size", "200x200", "-o", folder.file("pictures")});
  find_window();
  EXPECT_GT(colors_in(look()), 2u);
  program.signal(SIGTERM);
  EXPECT_EQ(program.wait(std::chrono::seconds(10)), 128 + SIGTERM) << program.errors();
  EXPECT_TRUE(program.complaints().empty()) << program.errors();
}

TEST_F(ViewWindow, orbits_pans_zooms_and_comes_back) {
  Program program({"view", pack, "--size", "320x240", "-o", folder.file("pictures")});
  find_window();
  const Picture first = look();
  const auto drag = [&](int button) {
    const std::string press = std::to_string(button);
    xdotool("mousemove 160 120 sleep 0.1 mousedown " + press +
            " sleep 0.1 mousemove 190 130 sleep 0.2 mouseup " + press + " sleep 0.1");
    return look();
  };
  const Picture orbited = drag(3);
  EXPECT_NE(orbited, first) << "the right button does not orbit";
  EXPECT_GT(colors_in(orbited), 2u) << "what was orbited is out of sight";
  const Picture panned = drag(2);
  EXPECT_NE(panned, orbited) << "the middle button does not pan";
  xdotool("click 4 sleep 0.2");
  const Picture zoomed = look();
  EXPECT_NE(zoomed, panned) << "the wheel does not zoom";
  xdotool("key Home");
  EXPECT_EQ(look(), first) << "Home is not the start";
  xdotool("key BackSpace");
  EXPECT_EQ(look(), zoomed) << "Backspace does not go back";
  std::vector<Picture> sides;
  for (const std::string key : {"1", "3", "7", "Home key 5"}) {
    xdotool("key " + key);
    const Picture side = look();
    EXPECT_GT(colors_in(side), 1u) << key;
    for (const Picture& other : sides) EXPECT_NE(side, other) << key;
    sides.push_back(side);
  }
  xdotool("key Home key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
}

TEST_F(ViewWindow, after_a_look_around_the_mouse_is_where_it_was) {
  Program program({"view", pack, "--size", "320x240", "-o", folder.file("pictures")});
  find_window();
  xdotool(
      "mousemove 160 120 sleep 0.1 mousedown 1 sleep 0.1 mousemove_relative 15 0 sleep 0.1 "
      "mousemove_relative "
      "25 0 sleep 0.2 mouseup 1 sleep 0.2");
  xdotool(
      "key F3 mousedown 3 sleep 0.1 mousemove_relative 20 0 sleep 0.2 mouseup 3 sleep 0.1 key F3 sleep 0.1 "
      "key "
      "Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  const auto heading = [&](const std::string& camera) {
    const nlohmann::json frame = json_of(folder.file("pictures/" + camera))["frames"][0];
    const auto way = [&](int axis) {
      return frame["target"][axis].get<double>() - frame["eye"][axis].get<double>();
    };
    return std::atan2(way(0), -way(2));
  };
  // A window's height turns by half a circle; the way of the look around is not gone once more.
  EXPECT_NEAR(heading("camera-001.json") - heading("camera-000.json"), 20 * std::numbers::pi / 240, 1e-6);
}

TEST_F(ViewWindow, names_what_is_clicked_on_and_saves_cameras_and_walks) {
  Program program({"view", pack, "--size", "320x240", "-o", folder.file("pictures")});
  find_window();
  const Picture first = look();
  click(160, 120);
  EXPECT_NE(title().find(", drawable "), std::string::npos) << title();
  EXPECT_NE(program.errors().find(" of scene node "), std::string::npos) << program.errors();
  click(2, 2);
  EXPECT_EQ(title().find(", drawable "), std::string::npos) << "the sky is no drawable: " << title();
  xdotool("key F3 sleep 0.1 key F4 keydown w sleep 0.3 keyup w sleep 0.2 key F4 sleep 0.2");
  const Picture walked = look();
  EXPECT_NE(walked, first);
  xdotool("key F4 keydown d sleep 0.2 keyup d sleep 0.3");  // never ended
  const Picture last = look();
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  // All are paths that show again what the person saw.
  const auto last_of = [&](const std::string& camera) {
    run({"render", pack, "--path", folder.file("pictures/" + camera), "--size", "320x240", "-o",
         folder.file(camera + "-again")});
    const nlohmann::json path_json = json_of(folder.file("pictures/" + camera));
    char name[32];
    std::snprintf(name, sizeof(name), "/%06d.png", static_cast<int>(path_json["frames"].size()) - 1);
    return read_picture(folder.file(camera + "-again") + name);
  };
  EXPECT_EQ(last_of("camera-000.json"), first);
  EXPECT_EQ(last_of("walk-000.json"), walked);
  EXPECT_EQ(last_of("walk-001.json"), last) << "a walk that was being recorded at the end";
}

TEST_F(ViewWindow, cuts_at_what_is_under_the_cursor_and_moves_the_cut) {
  Program program(view());
  find_window();
  const Picture first = look();
  xdotool("mousemove 160 120 sleep 0.2 key x");
  const Picture begun = look();
  EXPECT_NE(title().find("cut by 1 plane"), std::string::npos) << title();
  xdotool("key Prior key Prior key Prior");
  const Picture pushed = look();
  EXPECT_NE(pushed, first) << "Page Up does not move the cut";
  EXPECT_GT(colors_in(pushed), 2u);
  xdotool("key Next key Next key Next");
  EXPECT_EQ(look(), begun) << "Page Down does not move it back";
  xdotool("key Prior key Prior key Prior");
  EXPECT_EQ(look(), pushed);
  xdotool("key c");
  EXPECT_EQ(look(), pushed) << "the culled picture is not the un-culled one";
  xdotool("key c keydown alt click 4 keyup alt sleep 0.2");
  const Picture further = look();
  EXPECT_NE(further, pushed) << "the wheel with Alt does not move the cut";
  xdotool("key z");
  EXPECT_NE(look(), further) << "Z does not flip the cut";
  xdotool("key Delete");
  EXPECT_EQ(look(), first) << "Delete does not take it away";
  EXPECT_EQ(title().find("cut by"), std::string::npos) << title();
  xdotool("mousemove 160 120 sleep 0.1 click 1 sleep 0.3 key k");
  EXPECT_NE(look(), first) << "K cuts off what is outside of the selection's box";
  EXPECT_NE(title().find("cut by a box"), std::string::npos) << title();
  xdotool("key k key Escape sleep 0.3");
  EXPECT_EQ(look(), first) << "neither a box nor an outline";
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
}

TEST_F(ViewWindow, of_a_session_cuts_and_its_recording_has_the_cuts) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--record", folder.file("recording"), "--gather", "60", "-o", folder.file("pictures")});
  find_window();
  const Picture first = look();
  xdotool(
      "mousemove 160 120 sleep 0.2 key x sleep 0.2 key Prior sleep 0.2 key Prior sleep 0.2 key Prior sleep "
      "0.3");
  const Picture cut = look();
  EXPECT_NE(cut, first);
  EXPECT_NE(title().find("cut by 1 plane"), std::string::npos) << title();
  xdotool("key c");
  EXPECT_EQ(look(), cut) << "the culled picture is not the un-culled one";
  xdotool("key c sleep 0.3 key Escape");
  const nlohmann::json report = whole_session(program);
  run({"replay", folder.file("recording"), "--frames", "all", "-o", folder.file("replayed")});
  char last[32];
  std::snprintf(last, sizeof(last), "replayed/%06d.png", report["frames"].get<int>() - 1);
  EXPECT_EQ(read_picture(folder.file("replayed/000000.png")), first);
  EXPECT_EQ(read_picture(folder.file(last)), cut);
}

TEST_F(ViewWindow, of_a_session_shows_what_three_processes_make_of_a_person_s_cameras) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--record", folder.file("recording"), "--gather", "60"});
  walk_and_resize();
  xdotool("key c sleep 0.3");
  EXPECT_NE(title().find("culling off"), std::string::npos) << title();
  xdotool("key c key b sleep 0.3 key b sleep 0.3 key Escape");
  const nlohmann::json report = whole_session(program);
  // What the window showed is in the recording, in both sizes.
  run({"replay", folder.file("recording"), "--frames", "all", "-o", folder.file("replayed")});
  const Picture first = read_picture(folder.file("replayed/000000.png"));
  char last[32];
  std::snprintf(last, sizeof(last), "replayed/%06d.png", report["frames"].get<int>() - 1);
  const Picture end = read_picture(folder.file(last));
  EXPECT_EQ(first.width, 320u);
  EXPECT_EQ(end.width, 400u);
  EXPECT_GT(colors_in(first), 2u);
  EXPECT_GT(colors_in(end), 1u);
}

TEST_F(ViewWindow, of_a_session_shows_what_switch_nodes_on_other_machines_make_of_it) {
  const std::string hosts =
      write_hosts_file(folder.file("hosts.toml"), {.launch = "env MACHINE={host} {command}"});
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--hosts", hosts, "--gather", "60"});
  walk_and_resize();
  xdotool("key Escape");
  whole_session(program);
}

TEST_F(ViewWindow, goes_on_where_a_picture_cannot_be_saved) {
  const std::string pictures = folder.file("pictures");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"view"}, std::vector<std::string>{"session", "--window"}}) {
    SCOPED_TRACE(command.front());
    std::filesystem::remove_all(pictures);
    Program program(
        with(command, {pack, "--path", path, "--size", "320x240", "-o", pictures, "--json", json}));
    find_window();
    xdotool("key F2 sleep 0.3");
    EXPECT_TRUE(title_has("saved picture-000.png")) << title();
    EXPECT_TRUE(std::filesystem::exists(pictures + "/picture-000.png")) << "-o is not where F2 saves";
    std::filesystem::remove_all(pictures);
    std::ofstream(pictures) << "no folder";
    xdotool("key F2 sleep 0.5");
    EXPECT_TRUE(title_has("picture NOT saved")) << title();
    const std::string before = title();
    xdotool("keydown w sleep 0.4 keyup w sleep 0.3");
    EXPECT_NE(title(), before) << "the walk has ended";
    xdotool("key Escape");
    EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
    EXPECT_NE(program.errors().find("the picture is not saved: " + pictures), std::string::npos)
        << program.errors();
    std::filesystem::remove(pictures);
  }
}

TEST_F(ViewWindow, of_a_session_shows_its_first_picture_without_switch_nodes) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json});
  ::kill(program.role("switch 0"), SIGSTOP);
  ::kill(program.role("switch 1"), SIGSTOP);
  find_window();
  EXPECT_NE(title().find("culling on"), std::string::npos) << title();
  xdotool("keydown w sleep 0.3 keyup w");
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(20)), 0) << program.errors();
  EXPECT_FALSE(program.anybody_left());
  const nlohmann::json report = json_of(json);
  EXPECT_EQ(report["fallback_frames"], report["frames"]);
}

TEST_F(ViewWindow, of_a_session_waits_for_a_person_while_switch_nodes_hang) {
  Program program({"session", pack, "--window", "--path", path, "--size", "320x240", "--json", json,
                   "--connect-timeout", "0.3", "--gather", "60"});
  find_window();
  const auto said = [&](const char* words) {
    for (int tries = 0; tries < 3000 && program.errors().find(words) == std::string::npos; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return program.errors().find(words) != std::string::npos;
  };
  ASSERT_TRUE(said("both switch nodes are here")) << program.errors();
  // Nothing is drawn meanwhile, and nobody moves.
  ::kill(program.role("switch 1"), SIGKILL);
  EXPECT_TRUE(said("both switch nodes are back")) << program.errors();
  const pid_t hung = program.role("switch 0");
  ::kill(hung, SIGSTOP);
  xdotool("keydown w sleep 0.3 keyup w");
  EXPECT_TRUE(said("switch node 0 lost: no progress")) << program.errors();
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  ::kill(hung, SIGCONT);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  xdotool("key c sleep 0.5");
  double milliseconds = 0;
  size_t drawn = 0, cut = 1;
  ASSERT_EQ(
      std::sscanf(title().c_str(), "room.tpk: %lf ms, %zu of %zu drawables", &milliseconds, &drawn, &cut), 3)
      << title();
  EXPECT_LT(milliseconds, 2000) << "a rest is no frame time";
  EXPECT_EQ(drawn, cut) << "culling is off: the whole cut is drawn";
  xdotool("key Escape");
  EXPECT_EQ(program.wait(std::chrono::seconds(20)), 0) << program.errors();
  EXPECT_FALSE(program.anybody_left());
}

TEST_F(ViewWindow, of_a_session_needs_a_display_too) {
  ::unsetenv("DISPLAY");
  const std::string line = failure({"session", pack, "--window"});
  EXPECT_NE(line.find("triptych render"), std::string::npos) << line;
}

TEST_F(ViewWindow, needs_a_display_and_says_what_draws_without_one) {
  ::unsetenv("DISPLAY");
  const std::string line = failure(view());
  EXPECT_NE(line.find("triptych render"), std::string::npos) << line;
}

TEST_F(ViewWindow, a_pack_that_is_missing_is_one_line_and_no_window) {
  EXPECT_NE(failure({"view", folder.file("none.tpk")}).find("none.tpk"), std::string::npos);
}

}  // namespace
}  // namespace triptych::test
