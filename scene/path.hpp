// A recorded camera path (JSON, `"triptych_path": 1`), as samples write it and every command reads it.
#pragma once

#include "scene/camera.hpp"

#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// One camera of a path, before the viewport is known.
struct PathFrame {
  glm::dvec3 eye{0}, target{0}, up{0};
  double fov_y_degrees = 60;
  std::optional<double> orthographic_height{};  ///< model units; instead of the field of view
  std::optional<double> near{};
  std::optional<glm::dvec4> off_axis{};  ///< left, right, bottom, top tangents
  std::optional<double> time_seconds{};  ///< of what moves
};

struct Path {
  std::vector<PathFrame> frames;
  /// The view of frame i. default_near is used where the path names no near plane.
  View view(size_t i, int width, int height, double default_near) const;
};

/// Error (file and frame) for a file that is missing, is not a path, has no frames, holds a key that is not
/// known, a camera without a direction or with numbers that are not finite, or names two projections at once.
/// "comment" is allowed at the top and on frames, and is ignored.
Path load_path(const std::filesystem::path& file);

/// The same of a text. place: what errors name.
Path parse_path(const std::string& text, const std::string& place);

/// A path file that load_path() reads.
std::string path_text(const Path& path);

}  // namespace triptych
