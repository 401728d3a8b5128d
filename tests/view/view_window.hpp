// The program's window on a display of the test's own, and a person before it.
#pragma once

#include "tests/session/scene_files.hpp"
#include "tests/view/display.hpp"

#include <png.h>

namespace triptych::test {

struct Picture {
  unsigned width = 0, height = 0;
  std::vector<uint8_t> rgb;
  bool operator==(const Picture&) const = default;
};

inline Picture read_picture(const std::string& file) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  Picture picture;
  if (!png_image_begin_read_from_file(&image, file.c_str())) {
    ADD_FAILURE() << file << ": " << image.message;
    return picture;
  }
  image.format = PNG_FORMAT_RGB;
  picture = {image.width, image.height, std::vector<uint8_t>(PNG_IMAGE_SIZE(image))};
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, picture.rgb.data(), 0, nullptr)) << image.message;
  return picture;
}

/// How many colours there are, up to a limit: a picture of something has more than one.
inline size_t colors_in(const Picture& picture) {
  std::vector<uint32_t> seen;
  for (size_t i = 0; i + 2 < picture.rgb.size() && seen.size() < 10; i += 3) {
    const uint32_t color = static_cast<uint32_t>(picture.rgb[i]) << 16 |
                           static_cast<uint32_t>(picture.rgb[i + 1]) << 8 | picture.rgb[i + 2];
    if (std::find(seen.begin(), seen.end(), color) == seen.end()) seen.push_back(color);
  }
  return seen.size();
}

class ViewWindow : public SceneFiles {
 protected:
  std::vector<std::string> view(std::vector<std::string> more = {}) const {
    return with({"view", pack, "--path", path, "--size", "320x240", "-o", folder.file("pictures")},
                std::move(more));
  }

  /// Waits for the window and gives it the keyboard.
  void find_window() {
    window = xdotool("search --sync --onlyvisible --name room.tpk | head -n 1");
    ASSERT_FALSE(window.empty());
    // The first frame is drawn once the title has its figures.
    for (int tries = 0; tries < 2000 && title().find("culling") == std::string::npos; ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    xdotool("windowfocus --sync " + window);
  }
  std::string title() const { return xdotool("getwindowname " + window); }
  /// Now or soon.
  bool title_has(const std::string& words) const {
    for (int tries = 0; tries < 300; ++tries) {
      if (title().find(words) != std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  void click(int x, int y, const std::string& modifier = "") const {
    const std::string place = std::to_string(x) + " " + std::to_string(y);
    const bool held = !modifier.empty();
    xdotool((held ? "keydown " + modifier + " " : "") + "mousemove " + place +
            " sleep 0.1 click 1 sleep 0.3" + (held ? " keyup " + modifier : ""));
  }

  /// Each Esc ends one thing, and the last one the program.
  void leave(Program& program, int escapes = 1) const {
    for (int i = 0; i < escapes; ++i) xdotool("key Escape sleep 0.3");
    EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
  }

  /// Kills a session's render node and waits for the window of the next one.
  void kill_render_node(const Program& program) {
    std::this_thread::sleep_for(std::chrono::milliseconds(600));  // so that the place of now is kept
    const pid_t killed = program.role("render");
    ::kill(killed, SIGKILL);
    for (int tries = 0; tries < 2000 && program.last_role("render") == killed; ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_NE(program.last_role("render"), killed) << program.errors();
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    find_window();
  }

  /// Finds the window, walks, makes it 400x200 and walks on: a session's cameras as a person gives them.
  void walk_and_resize() {
    find_window();
    const std::string before = title();
    xdotool("keydown w sleep 0.4 keyup w sleep 0.3");
    EXPECT_NE(title(), before) << "W draws no other picture";
    xdotool("windowsize --sync " + window + " 400 200 sleep 0.3");
    xdotool("keydown a sleep 0.3 keyup a sleep 0.3");
  }

  /// What a session says that ends with nothing lost and nobody left.
  nlohmann::json whole_session(Program& program) const {
    EXPECT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
    nlohmann::json report = json_of(json);
    EXPECT_GT(report["frames"].get<int>(), 5);
    EXPECT_EQ(report["digest_mismatches"], 0);
    EXPECT_EQ(report["fallback_frames"], 0);
    EXPECT_FALSE(program.anybody_left());
    return report;
  }

  /// What the window shows: F2 saves it.
  Picture look() {
    char name[40];
    std::snprintf(name, sizeof(name), "pictures/picture-%03d.png", looks++);
    xdotool("key F2");
    for (int tries = 0; tries < 2000 && !std::filesystem::exists(folder.file(name)); ++tries) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return read_picture(folder.file(name));
  }

  Display display;
  std::string window;
  int looks = 0;
};

}  // namespace triptych::test
