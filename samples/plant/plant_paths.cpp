#include "samples/plant/plant.hpp"
#include "samples/plant/plant_site.hpp"
#include "samples/polyline.hpp"
#include "samples/walking.hpp"

#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

constexpr int walk_frames = 300, fly_frames = 300, spin_frames = 120, jump_frames = 60;
constexpr double walk_height = 2 * site::storey + eye_height;

}  // namespace

CameraFrames plant_walk() {
  // Straight on, a quarter circle in the crossing, straight on.
  constexpr double bend = 0.5, straight = 7;
  std::vector<glm::dvec3> line{{site::cross_aisle - straight, walk_height, site::near_aisle}};
  constexpr int steps = 64;
  for (int i = 0; i <= steps; ++i) {
    const double turn = glm::half_pi<double>() * i / steps;
    line.push_back({site::cross_aisle - bend + bend * std::sin(turn), walk_height,
                    site::near_aisle + bend - bend * std::cos(turn)});
  }
  line.push_back({site::cross_aisle, walk_height, site::near_aisle + 2 * straight});
  const auto eyes = resampled(line, walking_step, walk_frames);
  // The head turns before and after the feet: 90 degrees in 150 frames, at most 0.9 a frame.
  const double corner = straight / walking_step, half = 75;
  CameraFrames frames;
  for (int i = 0; i < walk_frames; ++i) {
    const double heading = glm::half_pi<double>() * glm::smoothstep(corner - half, corner + half, double(i));
    frames.push_back(looking(eyes[static_cast<size_t>(i)], heading, -0.04));
  }
  return frames;
}

CameraFrames plant_fly() {
  const double near = site::near_aisle, far = site::far_aisle, cross = site::cross_aisle;
  const std::vector<glm::dvec3> corners{{3, 24, 4},         {14, 20, 12},         {34, 17.5, 12},
                                        {cross, 15, 16},    {cross, 13.6, 24},    {cross, 13.6, near + 6},
                                        {cross, 14, 42},    {cross, 14, far - 4}, {56, 14, far},
                                        {80, 15, far},      {91, 20, far - 6},    {90, 22, 42},
                                        {88, 26, near + 2}, {70, 26, near},       {cross, 28, near + 4},
                                        {cross, 33, 42},    {44, 38, far - 4},    {20, 38, far},
                                        {8, 32, 48},        {5, 20, 36},          {8, 8, near},
                                        {28, 4, near},      {cross, 4, near - 8}, {70, 7, 12},
                                        {90, 16, 6}};
  const auto spline = spline_through(corners);
  constexpr size_t ahead = 6;
  const auto line = resampled(spline, length_of(spline) / (fly_frames + ahead + 0.5), fly_frames + ahead);
  CameraFrames frames;
  for (size_t i = 0; i < fly_frames; ++i) frames.push_back({line[i], line[i + ahead]});
  return frames;
}

CameraFrames plant_spin() {
  CameraFrames frames;
  for (int i = 0; i < spin_frames; ++i)
    frames.push_back(looking({site::cross_aisle, walk_height, site::near_aisle}, glm::radians(3.0 * i)));
  return frames;
}

CameraFrames plant_jump(Random random) {
  const auto aisles = site::aisles();
  CameraFrames frames;
  for (int i = 0; i < jump_frames; ++i) {
    const double heading = random.between(0, glm::two_pi<double>());
    if (i % 4 != 3) {
      const SiteBox& aisle = random.pick(aisles);
      const glm::dvec3 eye(random.between(aisle.low.x + 0.5, aisle.high.x - 0.5), aisle.low.y + eye_height,
                           random.between(aisle.low.z + 0.5, aisle.high.z - 0.5));
      frames.push_back(looking(eye, heading, random.between(-0.25, 0.25)));
    } else {
      // High in the turbine hall.
      const glm::dvec3 eye(random.between(3, site::width - 3), random.between(18, 25),
                           random.between(2, site::hall_depth - 2));
      frames.push_back(looking(eye, heading, random.between(-0.6, 0)));
    }
  }
  return frames;
}

}  // namespace triptych
