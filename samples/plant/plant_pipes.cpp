#include "samples/plant/plant_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {
namespace {

using Point = glm::dvec3;
// A service of a plant of 12.7 million triangles has as many pipes as there is room for; with fewer triangles
// there are fewer pipes, and coarser ones.
constexpr double triangles_of_all = 750'000, pipes_of_all = 900, growth = 0.6, min_pipes = 6;
constexpr double margin = 0.7;

struct Service {
  Point colour;
  double min_radius, max_radius;
};
constexpr size_t max_bundle = 8;

const std::array<Service, pipe_services> services{{{{0.62, 0.62, 0.60}, 0.10, 0.32},     // main steam, lagged
                                                   {{0.50, 0.18, 0.12}, 0.08, 0.25},     // reheat
                                                   {{0.16, 0.34, 0.20}, 0.06, 0.22},     // cooling water
                                                   {{0.20, 0.30, 0.50}, 0.05, 0.16},     // feed water
                                                   {{0.55, 0.45, 0.12}, 0.03, 0.08},     // gas and oil
                                                   {{0.52, 0.10, 0.08}, 0.03, 0.10},     // fire water
                                                   {{0.60, 0.62, 0.66}, 0.02, 0.05},     // compressed air
                                                   {{0.35, 0.36, 0.38}, 0.015, 0.04}}};  // sampling, conduits

/// A way along the axes, or nothing if it would be too short to be a pipe.
std::vector<Point> find_way(const PlantSite& site, double reach, Random& random) {
  const bool hall = random.chance(0.3);
  const Point low(margin, 0.3, hall ? margin : site::hall_depth + margin);
  const Point high(site::width - margin, (hall ? site::hall_height : site::height) - margin - reach,
                   site::depth - margin);
  const Point room = high - reach;
  std::vector<Point> line{{random.between(low.x, room.x), random.between(low.y, room.y),
                           random.between(low.z, hall ? site::hall_depth - margin - reach : room.z)}};
  // Most pipes hang under a floor.
  if (random.chance(0.7)) {
    const double storey = site::storey * static_cast<double>(random.below(hall ? 4 : site::storeys));
    line[0].y = std::min(storey + random.between(2.5, 5.2), room.y);
  }
  const size_t legs = 3 + random.below(5);
  int last = -1;
  for (size_t leg = 0, tries = 0; leg < legs && tries < 40; ++tries) {
    const int axis = static_cast<int>(random.below(3));
    if (axis == last) continue;
    const double most = axis == 0 ? 24 : axis == 1 ? 9 : 14, least = std::max(1.0, 4 * reach);
    const double length = least + (most - least) * random.uniform() * random.uniform();
    Point to = line.back();
    to[axis] += random.chance(0.5) ? length : -length;
    if (to[axis] < low[axis] || to[axis] > room[axis]) continue;
    // Under the hall's roof there is no way up from the hall.
    if (to.z < site::hall_depth + margin && to.y > site::hall_height - margin - reach) continue;
    const double play = 0.08;
    const SiteBox swept{glm::min(line.back(), to) - play, glm::max(line.back(), to) + reach + play};
    if (!site.is_free(swept)) continue;
    line.push_back(to);
    last = axis;
    ++leg;
  }
  return line;
}

}  // namespace

Shape make_pipes(const PlantSite& site, size_t service, uint64_t triangles, Random random) {
  const Service& kind = services.at(service);
  Shape shape(kind.colour);
  const double share = static_cast<double>(triangles) / triangles_of_all;
  const auto wanted =
      static_cast<size_t>(std::clamp(pipes_of_all * std::pow(share, growth), min_pipes, pipes_of_all));
  for (size_t pipes = 0; pipes < wanted;) {
    const double radius = kind.min_radius * std::pow(kind.max_radius / kind.min_radius, random.uniform());
    const size_t bundle = 1 + random.below(radius < 0.12 ? max_bundle : 3);
    // Neighbours are the same way, shifted along the diagonal: they never meet.
    const double shift = 2.2 * radius;
    const double reach = shift * static_cast<double>(bundle) + radius;
    const std::vector<Point> way = find_way(site, reach, random);
    if (way.size() < 3) continue;
    for (size_t i = 0; i < bundle; ++i) {
      std::vector<Point> line = way;
      for (Point& point : line) point += radius + shift * static_cast<double>(i);
      const size_t longest = [&] {
        size_t best = 1;
        for (size_t k = 2; k < line.size(); ++k)
          if (glm::distance(line[k], line[k - 1]) > glm::distance(line[best], line[best - 1])) best = k;
        return best;
      }();
      const Point from = line[longest - 1], to = line[longest];
      shape.tube(std::move(line), radius);
      // A pair of flanges where the pipe is straight, and one at its end.
      const Point along = glm::normalize(to - from),
                  middle = glm::mix(from, to, 0.4 + 0.03 * static_cast<double>(i));
      const double thick = 0.3 * radius + 0.02;
      shape.tube({middle - along * thick, middle + along * thick}, 1.5 * radius);
    }
    pipes += bundle;
  }
  return shape;
}

}  // namespace triptych
