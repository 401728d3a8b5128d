// Camera paths of the samples, and their files.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

struct CameraFrame {
  glm::dvec3 eye{0}, target{0};
  std::optional<double> time_seconds = {};  ///< of what moves
};
using CameraFrames = std::vector<CameraFrame>;

/// Of people who walk, metres: their eyes above the ground, and what they do in a 30th of a second.
inline constexpr double eye_height = 1.65, walking_step = 1.25 / 30;

/// The path file: `triptych_path` 1, 60 degrees, y up.
std::string path_json(const CameraFrames& frames);

}  // namespace triptych
