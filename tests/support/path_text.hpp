// Views as a path file says them.
#pragma once

#include "scene/camera.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace triptych::test {

/// A path file that gives these views again, viewports aside.
inline std::string path_text(const std::vector<View>& views) {
  using nlohmann::json;
  json frames = json::array();
  const auto list = [](const glm::dvec3& v) { return json{v.x, v.y, v.z}; };
  for (const View& view : views) {
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
  return json{{"triptych_path", 1}, {"frames", frames}}.dump();
}

}  // namespace triptych::test
