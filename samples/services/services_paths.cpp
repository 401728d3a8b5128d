#include "samples/services/services_paths.hpp"

#include "base/error.hpp"
#include "samples/free_space.hpp"
#include "samples/orbits.hpp"
#include "samples/polyline.hpp"
#include "samples/walking.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using namespace hospital;

constexpr size_t walk_frames = 600, fly_frames = 300, spin_frames = 120, jump_frames = 60;
constexpr Rect storey_area{0, 0, width, depth};

/// The storey next to the middle, from there downwards, that has no ceilings.
int storey_of_walk(size_t storeys) {
  const int middle = static_cast<int>(storeys / 2);
  return has_ceiling(middle, 0) ? std::max(middle - 1, 0) : middle;
}

bool worth_seeing(RoomUse use) {
  return use != RoomUse::shaft && use != RoomUse::stairs && use != RoomUse::store && use != RoomUse::lavatory;
}

std::vector<Stop> stops_on(const WalkableStorey& storey, const FreeSpace& space) {
  std::vector<Stop> stops;
  for (size_t i = 0; i < storey.rooms.size(); ++i) {
    const HospitalRoom& room = storey.rooms[i];
    const bool from_west = i > 0 && storey.rooms[i - 1].door_to_next;
    glm::dvec2 place;
    if (worth_seeing(room.use) && space.widest_place(room.area(), place))
      stops.push_back({i, room.area(), place, room.door_to_next || from_west});
  }
  return stops;
}

}  // namespace

CameraFrames services_walk(const std::vector<WalkableStorey>& storeys, const Random& random) {
  const int middle = storey_of_walk(storeys.size());
  const WalkableStorey& storey = storeys[static_cast<size_t>(middle)];
  const FreeSpace space(storey_area, storey.obstacles, walking_clearance + 0.01);
  return walk_through(stops_on(storey, space), space, walk_frames, hospital_level(middle) + eye_height,
                      fmt::format("storey {}", middle), random);
}

CameraFrames services_fly(int storeys) {
  const double eye = hospital_level(storey_of_walk(static_cast<size_t>(storeys))) + eye_height,
               roof = hospital_level(storeys);
  const double north = corridor_z[0], south = corridor_z[1];
  const std::vector<glm::dvec3> corners{
      {-40, roof + 8, -30}, {-24, eye + 5, -6},   {-12, eye, north},     {0, eye, north},
      {16, eye, north},     {32, eye, north},     {width, eye, north},   {60, eye, north + 2},
      {66, eye + 1, 19},    {60, eye, south - 2}, {width, eye, south},   {32, eye, south},
      {16, eye, south},     {0, eye, south},      {-14, eye + 1, south}, {-26, eye + 4, 46},
      {-10, roof + 2, 64},  {20, roof + 8, 68},   {48, roof + 12, 58},   {64, roof + 10, 36},
      {58, roof + 8, 14},   {38, roof + 6, 12},   {16, roof + 6, 20}};
  const auto spline = spline_through(corners);
  constexpr size_t ahead = 6;
  const auto line = resampled(spline, length_of(spline) / (fly_frames + ahead + 0.5), fly_frames + ahead);
  // Ahead inside; from outside, the farther away the more towards the building.
  const glm::dvec3 low(0), high(width, roof, depth);
  CameraFrames frames;
  for (size_t i = 0; i < fly_frames; ++i) {
    const glm::dvec3 &at = line[i], forward = glm::normalize(line[i + ahead] - at);
    const double share = 0.85 * glm::smoothstep(2.0, 12.0, glm::distance(at, glm::clamp(at, low, high)));
    frames.push_back({at, at + glm::mix(forward, glm::normalize(0.5 * (low + high) - at), share)});
  }
  return frames;
}

CameraFrames services_spin(const std::vector<WalkableStorey>& storeys) {
  const int middle = storey_of_walk(storeys.size());
  const WalkableStorey& storey = storeys[static_cast<size_t>(middle)];
  const FreeSpace space(storey_area, storey.obstacles, walking_clearance);
  const auto stops = stops_on(storey, space);
  const auto open = std::find_if(stops.begin(), stops.end(), [&](const Stop& stop) {
    const HospitalRoom& room = storey.rooms[stop.room];
    return !room.ceiling && room.use == RoomUse::ward;
  });
  if (stops.empty()) fail("spin.json", "no room on storey {} has a free place", middle);
  const glm::dvec2 place = (open == stops.end() ? stops.front() : *open).place;
  const glm::dvec3 eye(place.x, hospital_level(middle) + eye_height, place.y);
  CameraFrames frames;
  for (size_t i = 0; i < spin_frames; ++i)
    frames.push_back(looking(eye, glm::radians(3.0 * static_cast<double>(i)), 0.1));
  return frames;
}

CameraFrames services_jump(const std::vector<WalkableStorey>& storeys, Random random) {
  std::vector<std::vector<Stop>> stops;
  for (const WalkableStorey& storey : storeys)
    stops.push_back(stops_on(storey, FreeSpace(storey_area, storey.obstacles, walking_clearance)));
  const double roof = hospital_level(static_cast<int>(storeys.size()));
  CameraFrames frames;
  for (size_t i = 0; i < jump_frames; ++i) {
    const double heading = random.between(0, glm::two_pi<double>());
    const size_t storey = random.below(stops.size());
    const double eye = hospital_level(static_cast<int>(storey)) + eye_height;
    if (i % 4 == 3) {
      // Outside, looking back at the building.
      const glm::dvec3 middle(width / 2, roof / 2, depth / 2);
      const double away = random.between(12, 45);
      const glm::dvec3 from(middle.x + std::cos(heading) * (width / 2 + away), random.between(1.5, roof + 8),
                            middle.z + std::sin(heading) * (depth / 2 + away));
      frames.push_back({from, middle + glm::dvec3(random.between(-15, 15), 0, random.between(-8, 8))});
    } else if (i % 4 == 2 || stops[storey].empty()) {
      const glm::dvec3 from(random.between(2, width - 2), eye, corridor_z[random.below(2)]);
      frames.push_back(looking(from, random.chance(0.5) ? 0 : glm::pi<double>(), random.between(-0.1, 0.3)));
    } else {
      const glm::dvec2 place = random.pick(stops[storey]).place;
      frames.push_back(looking({place.x, eye, place.y}, heading, random.between(-0.2, 0.4)));
    }
  }
  return frames;
}

CameraFrames services_orbit(int storeys) {
  OrbitOptions options;
  options.centre = {width / 2, hospital_level(storeys) / 2, depth / 2};
  options.radius = 65;
  options.closest = 38;  // the corners are 31 m from the axis
  options.low = 3;
  options.high = hospital_level(storeys) + 25;
  return orbit_walk(options);
}

}  // namespace triptych
