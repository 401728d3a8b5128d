// A scene's pack and a path through it as files, for the program to read.
#pragma once

#include "tests/session/program.hpp"
#include "tests/support/path_text.hpp"
#include "tests/support/scenes.hpp"

#include <fstream>

namespace triptych::test {

/// room.tpk and path.json in a folder of the test's own.
class SceneFiles : public testing::Test {
 protected:
  SceneFiles() {
    scenes::write_pack("room", pack);
    const std::vector<View> views = scenes::path(scenes::pack("room").skeleton(), 160, 120);
    frame_count = views.size();
    std::ofstream(path) << path_text(views);
  }

  /// measure session, at a small size, with more arguments; whatever else the machine does, no role counts as
  /// lost.
  std::vector<std::string> measure(std::vector<std::string> more = {},
                                   const std::string& size = "160x120") const {
    return with(
        {"measure", "session", pack, "--path", path, "--size", size, "--json", json, "--timeout", "60000"},
        std::move(more));
  }
  /// session, at a small size, with all three roles from the first frame on.
  std::vector<std::string> session(std::vector<std::string> more = {}) const {
    return with({"session", pack, "--path", path, "--size", "160x120", "--gather", "60"}, std::move(more));
  }
  static std::vector<std::string> with(std::vector<std::string> arguments, std::vector<std::string> more) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }

  Folder folder;
  const std::string pack = folder.file("room.tpk"), path = folder.file("path.json"),
                    json = folder.file("out.json");
  size_t frame_count = 0;
};

}  // namespace triptych::test
