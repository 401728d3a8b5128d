#include "samples/orbits.hpp"

#include "base/file.hpp"
#include "samples/polyline.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

constexpr int walk_frames = 300, fly_frames = 300, spin_frames = 120, jump_frames = 60;

glm::dvec3 around(const OrbitOptions& options, double angle, double radius, double height) {
  return {options.centre.x + radius * std::cos(angle), height, options.centre.z + radius * std::sin(angle)};
}

/// What an eye looks at from here: the axis, at a height between its own and the centre's.
glm::dvec3 focus(const OrbitOptions& options, const glm::dvec3& eye) {
  return {options.centre.x, glm::mix(options.centre.y, eye.y, 0.5), options.centre.z};
}

}  // namespace

CameraFrames orbit_walk(const OrbitOptions& options) {
  constexpr int close_ups = 3;
  CameraFrames frames;
  for (int i = 0; i < walk_frames; ++i) {
    const double turn = glm::two_pi<double>() * i / walk_frames;
    const double near = 0.5 - 0.5 * std::cos(close_ups * turn);
    const glm::dvec3 eye = around(options, turn, glm::mix(options.radius, options.closest, near),
                                  glm::mix(options.low, options.high, 0.5 + 0.5 * std::sin(2 * turn)));
    frames.push_back({eye, focus(options, eye)});
  }
  return frames;
}

CameraFrames orbit_fly(const OrbitOptions& options) {
  const double far = 2 * options.radius, mean = 0.5 * (options.low + options.high);
  const std::vector<glm::dvec3> corners{around(options, 0.0, far, options.high),
                                        around(options, 0.8, 0.8 * far, options.high),
                                        around(options, 1.6, options.radius, mean),
                                        around(options, 2.3, options.closest, options.low),
                                        around(options, 3.0, options.closest, mean),
                                        around(options, 3.7, options.closest, options.high),
                                        around(options, 4.6, options.radius, options.high),
                                        around(options, 5.4, 0.8 * far, mean)};
  const auto spline = spline_through(corners);
  const auto line = resampled(spline, length_of(spline) / (fly_frames - 0.5), fly_frames);
  CameraFrames frames;
  for (const glm::dvec3& eye : line) frames.push_back({eye, focus(options, eye)});
  return frames;
}

CameraFrames orbit_spin(const OrbitOptions& options) {
  CameraFrames frames;
  for (int i = 0; i < spin_frames; ++i) {
    const double turn = glm::radians(3.0 * i);
    frames.push_back({options.spin, options.spin + glm::dvec3(std::cos(turn), 0, std::sin(turn))});
  }
  return frames;
}

CameraFrames orbit_jump(const OrbitOptions& options, Random random) {
  CameraFrames frames;
  for (int i = 0; i < jump_frames; ++i) {
    const double turn = random.between(0, glm::two_pi<double>());
    const double radius = random.between(options.closest, 2 * options.radius);
    const glm::dvec3 eye = around(options, turn, radius, random.between(options.low, options.high));
    const double stray = 0.1 * options.radius;
    frames.push_back(
        {eye, focus(options, eye) + glm::dvec3(random.between(-stray, stray), random.between(-stray, stray),
                                               random.between(-stray, stray))});
  }
  return frames;
}

void write_orbits(const OrbitOptions& options, const Random& random, const std::filesystem::path& folder) {
  const auto write = [&](const char* name, CameraFrames frames) {
    for (size_t i = 0; options.frames_a_second > 0 && i < frames.size(); ++i)
      frames[i].time_seconds = static_cast<double>(i) / options.frames_a_second;
    write_file(folder / name, path_json(frames));
  };
  write("walk.json", orbit_walk(options));
  write("fly.json", orbit_fly(options));
  write("spin.json", orbit_spin(options));
  write("jump.json", orbit_jump(options, random));
}

}  // namespace triptych
