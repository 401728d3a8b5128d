// The window within a cap of memory that what a section cuts does not fit into.
#include "tests/view/view_window.hpp"

namespace triptych::test {
namespace {

class CappedWindow : public ViewWindow {
 protected:
  CappedWindow() {
    const std::string sample = folder.file("s");
    run({"sample", "isosurface", "-o", sample, "--triangles", "400000"});
    run({"build", sample + "/scene.ply", "-o", pack});
    arguments = {"--path",
                 sample + "/walk.json",
                 "--size",
                 "320x240",
                 "--device-memory",
                 "1M",
                 "--section",
                 "x<1",
                 "--json",
                 json,
                 "-o",
                 folder.file("pictures")};
  }
  bool title_lacks(const std::string& words) const {
    for (int tries = 0; tries < 1000; ++tries) {
      if (title().find(words) == std::string::npos) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  /// The cut has no room; without it there is, and pictures get finer while nobody does anything.
  void walk(Program& program) {
    find_window();
    EXPECT_TRUE(title_has("NO ROOM for ")) << title();
    EXPECT_TRUE(title_has("px (asked for 1)")) << title();
    const Picture starved = look();
    EXPECT_GT(colors_in(starved), 1u);
    xdotool("keydown w sleep 0.2 keyup w");
    xdotool("key Delete");
    EXPECT_TRUE(title_lacks("NO ROOM")) << title();
    EXPECT_TRUE(title_lacks("4096 px")) << title();
    EXPECT_NE(look(), starved);
    xdotool("key Escape");
    ASSERT_EQ(program.wait(std::chrono::seconds(60)), 0) << program.errors();
    const nlohmann::json report = json_of(json);
    EXPECT_GT(report["leaving_out_frames"], 0);
    EXPECT_LT(report["leaving_out_frames"], report["frames"]);
    EXPECT_GT(report["left_out_drawables"], 0);
    EXPECT_LE(report["peak_device_bytes"], 1 << 20);
  }
  std::vector<std::string> arguments;
};

TEST_F(CappedWindow, goes_on_where_what_is_cut_has_no_room_and_says_so) {
  Program program(with({"view", pack}, arguments));
  walk(program);
}

TEST_F(CappedWindow, of_a_session_does_so_too) {
  Program program(with({"session", pack, "--window", "--gather", "60"}, arguments));
  walk(program);
}

}  // namespace
}  // namespace triptych::test
