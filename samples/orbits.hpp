// The four camera paths around a model that is looked at rather than walked through.
#pragma once

#include "samples/camera_paths.hpp"
#include "samples/random.hpp"

#include <filesystem>

namespace triptych {

struct OrbitOptions {
  glm::dvec3 centre{0};        ///< the orbits' axis and what the eye looks at
  double radius = 1;           ///< from where the whole model can be seen
  double closest = 0.5;        ///< how near to the axis the close-ups come
  double low = 0, high = 1;    ///< heights between which the eye moves
  glm::dvec3 spin{0};          ///< where the spinning eye stands
  double frames_a_second = 0;  ///< by which frames name a time; 0: they name none
};

/// 300 frames of one slow orbit that comes close and goes away three times.
CameraFrames orbit_walk(const OrbitOptions& options);
/// 300 frames of a flight: around from afar, down, and close along the model from one end to the other.
CameraFrames orbit_fly(const OrbitOptions& options);
/// 120 frames on one spot, turning by 3 degrees each.
CameraFrames orbit_spin(const OrbitOptions& options);
/// 60 views from random places around, near and far.
CameraFrames orbit_jump(const OrbitOptions& options, Random random);

/// Writes the four as `walk.json`, `fly.json`, `spin.json` and `jump.json` into a folder that is there.
void write_orbits(const OrbitOptions& options, const Random& random, const std::filesystem::path& folder);

}  // namespace triptych
