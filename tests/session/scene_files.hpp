// A scene's pack and a path through it as files, for the program to read.
#pragma once

#include "tests/session/program.hpp"
#include "tests/support/scenes.hpp"

#include <fstream>

namespace triptych::test {

/// room.tpk and path.json in a folder of the test's own.
class SceneFiles : public testing::Test {
 protected:
  SceneFiles() {
    scenes::write_pack("room", pack);
    nlohmann::json frames = nlohmann::json::array();
    const auto list = [](const glm::dvec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
    for (const View& view : scenes::path(scenes::pack("room").skeleton(), 160, 120)) {
      const Camera& camera = view.camera;
      frames.push_back({{"eye", list(camera.eye)},
                        {"target", list(camera.target)},
                        {"up", list(camera.up)},
                        {"near", camera.near}});
      if (camera.orthographic()) {
        frames.back()["orthographic_height"] = camera.top - camera.bottom;
      } else {
        frames.back()["off_axis"] = {camera.left, camera.right, camera.bottom, camera.top};
      }
    }
    frame_count = frames.size();
    std::ofstream(path) << nlohmann::json{{"triptych_path", 1}, {"frames", frames}};
  }

  /// measure session, at a small size, with more arguments; whatever else the machine does, no role counts as
  /// lost.
  std::vector<std::string> measure(std::vector<std::string> more = {},
                                   const std::string& size = "160x120") const {
    return with(
        {"measure", "session", pack, "--path", path, "--size", size, "--json", json, "--timeout", "60000"},
        std::move(more));
  }
  std::vector<std::string> session(std::vector<std::string> more = {}) const {
    return with({"session", pack, "--path", path, "--size", "160x120"}, std::move(more));
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
