#include "samples/walking.hpp"

#include "base/error.hpp"
#include "samples/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using Line = std::vector<glm::dvec2>;

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

/// Whether the way turns sharply somewhere: people do not walk backwards.
bool turns_back(const Line& line) {
  constexpr size_t reach = 8;
  for (size_t i = reach; i + reach < line.size(); ++i)
    if (glm::dot(line[i] - line[i - reach], line[i + reach] - line[i]) < -0.02) return true;
  return false;
}

/// Where the way comes into the room that it ends in.
glm::dvec2 entrance(const Line& line, const Rect& room) {
  size_t i = line.size() - 1;
  while (i > 0 && room.grown(0.01).overlaps({line[i].x, line[i].y, line[i].x, line[i].y})) --i;
  return line[i];
}

/// From room to room, through one that has two doors; if there is none on the way, along the corridors alone.
Line find_walk(const std::vector<Stop>& stops, const FreeSpace& space, double needed, Random random) {
  constexpr double door_way = 0.9;
  const double reach = needed + 12;
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
      if (length < needed / 4 || length > needed || !middle.through) continue;
      const glm::dvec2 door = entrance(line, middle.area);
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

CameraFrame looking(const glm::dvec3& eye, double heading, double slope) {
  return {eye, eye + glm::dvec3(std::cos(heading), slope, std::sin(heading))};
}

CameraFrames walk_through(const std::vector<Stop>& stops, const FreeSpace& space, size_t frames,
                          double eye_level, const std::string& place, const Random& random) {
  const double distance = static_cast<double>(frames) * walking_step;
  const Line found = find_walk(stops, space, distance + 2, random);
  if (found.empty()) fail("walk.json", "no way of {} metres through {}", distance, place);
  const Line line = resampled(found, walking_step, frames + 40);
  if (line.size() < frames) fail("walk.json", "the way through {} ends after {} frames", place, line.size());
  const auto heading = headings(line, frames);
  CameraFrames walk;
  for (size_t i = 0; i < frames; ++i) walk.push_back(looking({line[i].x, eye_level, line[i].y}, heading[i]));
  return walk;
}

}  // namespace triptych
