#include "samples/camera_paths.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace triptych {

std::string path_json(const CameraFrames& frames) {
  nlohmann::ordered_json path = {
      {"triptych_path", 1}, {"fov_y_degrees", 60}, {"frames", nlohmann::ordered_json::array()}};
  const auto rounded = [](const glm::dvec3& v) {
    constexpr double digits = 1e6;
    return nlohmann::ordered_json{std::round(v.x * digits) / digits, std::round(v.y * digits) / digits,
                                  std::round(v.z * digits) / digits};
  };
  for (const CameraFrame& frame : frames) {
    path["frames"].push_back(
        {{"eye", rounded(frame.eye)}, {"target", rounded(frame.target)}, {"up", {0, 1, 0}}});
    if (frame.time_seconds) path["frames"].back()["time_seconds"] = *frame.time_seconds;
  }
  return path.dump() + "\n";
}

}  // namespace triptych
