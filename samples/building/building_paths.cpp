#include "samples/building/building_paths.hpp"

#include "base/error.hpp"
#include "samples/building/free_space.hpp"
#include "samples/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using Line = std::vector<glm::dvec2>;
constexpr int walk_frames = 300, fly_frames = 300, spin_frames = 120, jump_frames = 60;

/// Rounds corners off, as far as the way stays free.
Line smoothed(Line line, const FreeSpace& space) {
  for (int round = 0; round < 400; ++round) {
    for (size_t i = 1; i + 1 < line.size(); ++i) {
      const glm::dvec2 moved = 0.5 * line[i] + 0.25 * (line[i - 1] + line[i + 1]);
      if (space.is_free(moved)) line[i] = moved;
    }
  }
  return line;
}

double turned(double from, double to) { return std::remainder(to - from, glm::two_pi<double>()); }

/// Looks ahead along the way; the head turns smoothly.
std::vector<double> headings(const Line& line, size_t count) {
  constexpr size_t ahead = 32;  // frames: 1.5 metres
  const double most = glm::radians(0.8), more = glm::radians(0.05);
  std::vector<double> result;
  double heading = 0, speed = 0;
  for (size_t i = 0; i < count; ++i) {
    const glm::dvec2 direction = line[std::min(i + ahead, line.size() - 1)] - line[i];
    const double wanted = glm::length(direction) < 0.2 ? heading : std::atan2(direction.y, direction.x);
    if (i == 0) heading = wanted;
    const double aimed = std::clamp(turned(heading, wanted) * 0.06, -most, most);
    speed += std::clamp(aimed - speed, -more, more);
    heading += speed;
    result.push_back(heading);
  }
  return result;
}

CameraFrame looking(const glm::dvec3& eye, double heading, double slope = 0) {
  return {eye, eye + glm::dvec3(std::cos(heading), slope, std::sin(heading))};
}

bool worth_seeing(RoomType type) {
  return type != RoomType::corridor && type != RoomType::hall && type != RoomType::stairs &&
         type != RoomType::lavatory;
}

struct Stop {
  size_t room;
  glm::dvec2 place;
};

std::vector<Stop> stops_on(const FloorPlan& plan, int floor, const FreeSpace& space) {
  std::vector<Stop> stops;
  for (size_t i = 0; i < plan.rooms.size(); ++i) {
    glm::dvec2 place;
    if (plan.rooms[i].floor == floor && worth_seeing(plan.rooms[i].type) &&
        space.widest_place(plan.rooms[i], place))
      stops.push_back({i, place});
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

/// Whether the way turns sharply somewhere: people do not walk backwards.
bool turns_back(const Line& line) {
  constexpr size_t reach = 8;
  for (size_t i = reach; i + reach < line.size(); ++i)
    if (glm::dot(line[i] - line[i - reach], line[i + reach] - line[i]) < -0.02) return true;
  return false;
}

/// Where the way comes into the room that it ends in.
glm::dvec2 entrance(const Line& line, const Room& room) {
  size_t i = line.size() - 1;
  while (i > 0 && room.area.grown(0.01).overlaps({line[i].x, line[i].y, line[i].x, line[i].y})) --i;
  return line[i];
}

/// From room to room, through one that has two doors; if there is none on the way, along the corridors alone.
Line find_walk(const FloorPlan& plan, const std::vector<Stop>& stops, const FreeSpace& space, Random random) {
  constexpr double needed = walk_frames * walking_step + 2, reach = needed + 12, door_way = 0.9;
  const auto usable = [&](Line& line) {
    if (length_of(line) < needed) return false;
    line = smoothed(std::move(line), space);
    return length_of(line) >= needed && !turns_back(line);
  };
  auto order = stops;
  random.shuffle(order);
  order.resize(std::min<size_t>(order.size(), 12));
  Line direct;
  for (const Stop& start : order) {
    const auto first = space.ways_from(start.place, reach);
    for (const Stop& middle : stops) {
      const double length = space.length_to(first, middle.place);
      if (middle.room == start.room || length > reach) continue;
      Line line = space.way_to(first, middle.place);
      if (Line whole = line; direct.empty() && usable(whole)) direct = whole;
      if (length < needed / 4 || length > needed || plan.rooms[middle.room].area.width() < 8) continue;
      const glm::dvec2 door = entrance(line, plan.rooms[middle.room]);
      const auto second =
          space.ways_from(middle.place, reach, Rect{door.x, door.y, door.x, door.y}.grown(door_way));
      for (const Stop& end : stops) {
        if (end.room == middle.room || end.room == start.room || space.length_to(second, end.place) > reach)
          continue;
        Line whole = line;
        const Line rest = space.way_to(second, end.place);
        whole.insert(whole.end(), rest.begin() + 1, rest.end());
        if (usable(whole)) return whole;
      }
    }
  }
  return direct;
}

}  // namespace

CameraFrames make_walk(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                       const Random& random) {
  const int floor = plan.floors / 2;
  const FreeSpace space(obstacles(plan, placements, floor), walking_clearance + 0.01);
  const Line found = find_walk(plan, stops_on(plan, floor, space), space, random);
  if (found.empty())
    fail("walk.json", "no way of {} metres through floor {}", walk_frames * walking_step, floor);
  const Line line = resampled(found, walking_step, walk_frames + 40);
  if (line.size() < walk_frames)
    fail("walk.json", "the way through floor {} ends after {} frames", floor, line.size());
  const auto heading = headings(line, walk_frames);
  CameraFrames frames;
  for (size_t i = 0; i < walk_frames; ++i)
    frames.push_back(looking({line[i].x, floor_level(floor) + eye_height, line[i].y}, heading[i]));
  return frames;
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
  const FreeSpace space(obstacles(plan, placements, floor), walking_clearance);
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
  const Room& room = plan.rooms[stops[0].room];
  glm::dvec2 place = stops[0].place;
  for (double z = room.area.z0; z < room.area.z1; z += 0.1)
    for (double x = room.area.x0; x < room.area.x1; x += 0.1)
      if (space.is_free({x, z}) &&
          glm::distance(glm::dvec2(x, z), room.area.centre()) < glm::distance(place, room.area.centre()))
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
    stops.push_back(stops_on(plan, floor, FreeSpace(obstacles(plan, placements, floor), walking_clearance)));
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
