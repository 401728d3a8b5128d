#include "samples/building/building_paths.hpp"

#include "base/error.hpp"
#include "samples/building/obstacles.hpp"
#include "samples/free_space.hpp"
#include "samples/polyline.hpp"
#include "samples/walking.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

constexpr int walk_frames = 300, fly_frames = 300, spin_frames = 120, jump_frames = 60;
constexpr Rect storey_area{0, 0, measures::width, measures::depth};

bool worth_seeing(RoomType type) {
  return type != RoomType::corridor && type != RoomType::hall && type != RoomType::stairs &&
         type != RoomType::lavatory;
}

std::vector<Stop> stops_on(const FloorPlan& plan, int floor, const FreeSpace& space) {
  std::vector<Stop> stops;
  for (size_t i = 0; i < plan.rooms.size(); ++i) {
    const Room& room = plan.rooms[i];
    constexpr double with_two_doors = 8;
    glm::dvec2 place;
    if (room.floor == floor && worth_seeing(room.type) && space.widest_place(room.area, place))
      stops.push_back({i, room.area, place, room.area.width() >= with_two_doors});
  }
  return stops;
}

/// Ahead inside; from outside, the farther away the more towards the building.
glm::dvec3 fly_direction(const glm::dvec3& eye, const glm::dvec3& ahead, double roof) {
  const glm::dvec3 low(0), high(measures::width, roof, measures::depth);
  const double away = glm::distance(eye, glm::clamp(eye, low, high));
  const glm::dvec3 focus =
      glm::clamp(eye + 12.0 * ahead, low + glm::dvec3(10, 2, 10), high - glm::dvec3(10, 1, 10));
  const double share = glm::smoothstep(2.0, 12.0, away) * 0.8;
  return glm::mix(ahead, glm::normalize(focus - eye), share);
}

}  // namespace

CameraFrames make_walk(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random) {
  const int floor = plan.floors / 2;
  const FreeSpace space(storey_area, obstacles(plan, placements, floor), walking_clearance + 0.01);
  return walk_through(stops_on(plan, floor, space), space, walk_frames, floor_level(floor) + eye_height,
                      fmt::format("floor {}", floor), random);
}

CameraFrames make_fly(const FloorPlan& plan) {
  const double eye = floor_level(plan.floors / 2) + eye_height, roof = floor_level(plan.floors);
  constexpr double north = 6.8, south = 33.2, hall = 20, middle = 30;
  const std::vector<glm::dvec3> corners{{-38, roof + 8, -30},
                                        {-25, eye + 4, -4},
                                        {-12, eye, north},
                                        {0, eye, north},
                                        {30, eye, north},
                                        {60, eye, north},
                                        {70, eye, north + 2},
                                        {76, eye + 2, hall},
                                        {70, eye, south - 2},
                                        {60, eye, south},
                                        {45, eye, south},
                                        {33, eye, south - 0.4},
                                        {middle, eye, south - 4},
                                        {middle, eye, 27},
                                        {middle, eye, 22.5},
                                        {middle, eye + 2, hall},
                                        {middle, roof + 4, hall - 2},
                                        {22, roof + 9, 8},
                                        {4, roof + 8, -8},
                                        {-16, eye + 6, -2},
                                        {-22, eye + 2, 18},
                                        {-14, eye, 40},
                                        {8, eye + 1, 52},
                                        {34, eye + 1, 50}};
  const std::vector<glm::dvec3> spline = spline_through(corners);
  constexpr size_t ahead = 7;
  const auto line = resampled(spline, length_of(spline) / (fly_frames + ahead + 0.5), fly_frames + ahead);
  std::vector<glm::dvec3> directions;
  for (size_t i = 0; i < fly_frames; ++i)
    directions.push_back(fly_direction(line[i], glm::normalize(line[i + ahead] - line[i]), roof));
  CameraFrames frames;
  for (size_t i = 0; i < fly_frames; ++i) {
    glm::dvec3 direction(0);
    for (size_t k = i < 8 ? 0 : i - 8; k <= std::min<size_t>(i + 8, fly_frames - 1); ++k)
      direction += directions[k];
    const double steepest = 0.8 * std::hypot(direction.x, direction.z);
    direction.y = std::clamp(direction.y, -steepest, steepest);
    frames.push_back({line[i], line[i] + glm::normalize(direction)});
  }
  return frames;
}

CameraFrames make_spin(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random) {
  const int floor = plan.floors / 2;
  const FreeSpace space(storey_area, obstacles(plan, placements, floor), walking_clearance);
  auto stops = stops_on(plan, floor, space);
  if (stops.empty()) fail("spin.json", "no room on floor {} has a free place", floor);
  Random choice = random;
  const auto rank = [&](const Stop& stop) {
    const RoomType type = plan.rooms[stop.room].type;
    return type == RoomType::open_office || type == RoomType::computer_room || type == RoomType::classroom;
  };
  choice.shuffle(stops);
  std::stable_sort(stops.begin(), stops.end(),
                   [&](const Stop& a, const Stop& b) { return rank(a) > rank(b); });
  // As near to the middle of the room as there is room to stand.
  const Rect& area = stops[0].area;
  glm::dvec2 place = stops[0].place;
  for (double z = area.z0; z < area.z1; z += 0.1)
    for (double x = area.x0; x < area.x1; x += 0.1)
      if (space.is_free({x, z}) &&
          glm::distance(glm::dvec2(x, z), area.centre()) < glm::distance(place, area.centre()))
        place = {x, z};
  const glm::dvec3 eye(place.x, floor_level(floor) + eye_height, place.y);
  CameraFrames frames;
  for (int i = 0; i < spin_frames; ++i) frames.push_back(looking(eye, glm::radians(3.0 * i)));
  return frames;
}

CameraFrames make_jump(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random) {
  Random choice = random;
  std::vector<std::vector<Stop>> stops;
  for (int floor = 0; floor < plan.floors; ++floor)
    stops.push_back(
        stops_on(plan, floor, FreeSpace(storey_area, obstacles(plan, placements, floor), walking_clearance)));
  CameraFrames frames;
  for (int i = 0; i < jump_frames; ++i) {
    const auto floor = choice.below(stops.size());
    const double heading = choice.between(0, glm::two_pi<double>());
    if (i % 4 != 3 && !stops[floor].empty()) {
      const glm::dvec2 place = choice.pick(stops[floor]).place;
      frames.push_back(looking({place.x, floor_level(static_cast<int>(floor)) + eye_height, place.y}, heading,
                               choice.between(-0.25, 0.15)));
      continue;
    }
    // Outside, looking back at the building.
    const glm::dvec3 middle(measures::width / 2, floor_level(plan.floors) / 2, measures::depth / 2);
    const double away = choice.between(12, 45);
    const glm::dvec3 eye(middle.x + std::cos(heading) * (measures::width / 2 + away),
                         choice.between(1.5, floor_level(plan.floors) + 6),
                         middle.z + std::sin(heading) * (measures::depth / 2 + away));
    const glm::dvec2 back(middle.x - eye.x + choice.between(-15, 15),
                          middle.z - eye.z + choice.between(-15, 15));
    frames.push_back(looking(eye, std::atan2(back.y, back.x), choice.between(-0.15, 0.1)));
  }
  return frames;
}

}  // namespace triptych
