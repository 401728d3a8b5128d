#include "samples/plant/plant_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {
namespace {

using Point = glm::dvec3;
const Point steel(0.16, 0.25, 0.20), grate(0.32, 0.33, 0.34), cladding(0.55, 0.58, 0.60),
    concrete(0.45, 0.44, 0.42), yellow(0.80, 0.58, 0.05), roofing(0.35, 0.36, 0.40);
constexpr double strip_lines[] = {0, 24, 33, 42, 51, 60};

/// Two flanges and a web, standing.
void add_column(Shape& shape, const Point& foot, double height) {
  const double half = 0.22, plate = 0.03;
  shape.box(foot + Point(-plate / 2, 0, -half), foot + Point(plate / 2, height, half));
  for (const double side : {-1.0, 1.0}) {
    const double z = side * half;
    shape.box(foot + Point(-half, 0, z - plate / 2), foot + Point(half, height, z + plate / 2));
  }
  shape.box(foot + Point(-0.4, 0, -0.4), foot + Point(0.4, 0.05, 0.4));
}

/// Two flanges and a web, lying.
void add_beam(Shape& shape, const Point& from, const Point& to) {
  const Point side = std::abs(to.x - from.x) > std::abs(to.z - from.z) ? Point(0, 0, 1) : Point(1, 0, 0);
  const Point up(0, 0.22, 0);
  shape.bar(from, to, 0.02, 0.44, side);
  shape.bar(from + up, to + up, 0.25, 0.03, side);
  shape.bar(from - up, to - up, 0.25, 0.03, side);
}

Shape grating(const SiteBox& area, uint64_t triangles) {
  Shape shape(grate);
  const auto bars = static_cast<int>(std::min<uint64_t>(triangles / 12, 700));
  constexpr int min_bars = 40;
  if (bars < min_bars) {
    shape.box(area.low, area.high);
    return shape;
  }
  // Bearing bars across, and half as many lighter ones along.
  const int bearing = bars * 2 / 3, crossing = bars - bearing;
  const Point size = area.high - area.low;
  const double gap = size.x / bearing, thin = std::min(0.4 * gap, 0.03);
  for (int i = 0; i < bearing; ++i) {
    const double x = area.low.x + (i + 0.5) * gap;
    shape.box({x - thin / 2, area.low.y, area.low.z}, {x + thin / 2, area.high.y, area.high.z});
  }
  for (int i = 0; i < crossing; ++i) {
    const double z = area.low.z + (i + 0.5) * size.z / crossing;
    shape.box({area.low.x, area.high.y - 0.012, z - 0.006}, {area.high.x, area.high.y - 0.002, z + 0.006});
  }
  return shape;
}

Shape railing(const Point& from, const Point& to) {
  Shape shape(yellow);
  for (const double up : {1.1, 0.55}) shape.tube({from + Point(0, up, 0), to + Point(0, up, 0)}, 0.022);
  const int posts = static_cast<int>(glm::distance(from, to) / 1.2);
  for (int i = 0; i <= posts; ++i) {
    const Point foot = glm::mix(from, to, double(i) / posts);
    shape.cylinder(foot, 1, 1.1, 0.02);
  }
  shape.bar(from + Point(0, 0.05, 0), to + Point(0, 0.05, 0), 0.01, 0.1);
  return shape;
}

/// Two flights between two floors, with a landing.
Shape stairs(const Point& foot) {
  Shape shape(grate);
  constexpr int steps = 16;
  const double rise = site::storey / (2 * steps), going = 0.26, wide = 0.9;
  for (int flight = 0; flight < 2; ++flight) {
    const double z = foot.z + flight * (wide + 0.1), sign = flight == 0 ? 1 : -1;
    const Point start(foot.x + (flight == 0 ? 0 : steps * going), foot.y + flight * site::storey / 2, z);
    const Point end = start + Point(sign * steps * going, site::storey / 2, 0);
    for (const double side : {0.0, wide})
      shape.bar(start + Point(0, 0, side), end + Point(0, 0, side), 0.02, 0.25);
    for (const double side : {0.0, wide})
      for (const double up : {1.0, 0.5})
        shape.tube({start + Point(0, up, side), end + Point(0, up, side)}, 0.02);
    for (int i = 0; i < steps; ++i) {
      const Point tread = start + Point(sign * (i + 0.5) * going, (i + 1) * rise, wide / 2);
      shape.box(tread - Point(going / 2, 0.03, wide / 2), tread + Point(going / 2, 0, wide / 2));
    }
  }
  const double x = foot.x + steps * going, y = foot.y + site::storey / 2;
  shape.box({x, y - 0.05, foot.z}, {x + 1.0, y, foot.z + 2 * wide + 0.1});
  return shape;
}

/// A corrugated sheet: a plate with ribs, `normal` 0 along x or 2 along z.
Shape wall_panel(const SiteBox& area, int normal, uint64_t triangles) {
  Shape shape(cladding);
  shape.box(area.low, area.high);
  const int run = normal == 0 ? 2 : 0;
  const double length = area.high[run] - area.low[run];
  const auto ribs = static_cast<int>(std::clamp<uint64_t>(triangles / 12, 2, 80));
  for (int i = 0; i < ribs; ++i) {
    Point low = area.low, high = area.high;
    const double at = area.low[run] + (i + 0.5) * length / ribs;
    low[run] = at - 0.25 * length / ribs;
    high[run] = at + 0.25 * length / ribs;
    low[normal] -= 0.04;
    high[normal] += 0.04;
    shape.box(low, high);
  }
  for (int i = 1; i < 4; ++i) {
    Point from = area.low, to = area.low;
    from.y = to.y = glm::mix(area.low.y, area.high.y, i / 4.0);
    to[run] = area.high[run];
    from[normal] = to[normal] = 0.5 * (area.low[normal] + area.high[normal]);
    shape.tube({from, to}, 0.09);
  }
  return shape;
}

void add_walls(PlantObjects& objects, const PlantSite& site) {
  constexpr int tiers = 3;
  const auto add = [&](const char* name, SiteBox area, int normal) {
    if (site.in_aisle(area.grown(0.06))) return;
    objects.push_back({name, 900, [area, normal](uint64_t n) { return wall_panel(area, normal, n); }});
  };
  for (int tier = 0; tier < tiers; ++tier) {
    const auto band = [&](double height, double share) { return height * (tier + share) / tiers; };
    for (int i = 0; i < site::bays; ++i) {
      const double x = i * site::bay, to = x + site::bay;
      add("wall south", {{x, band(site::hall_height, 0), 0}, {to, band(site::hall_height, 1), 0.05}}, 2);
      add("wall north",
          {{x, band(site::height, 0), site::depth - 0.05}, {to, band(site::height, 1), site::depth}}, 2);
      // The wall between hall and boilers has a gate in the middle.
      if (tier == 0 && (i == 5 || i == 6)) continue;
      add("wall between",
          {{x, band(site::height, 0), site::hall_depth - 0.05},
           {to, band(site::height, 1), site::hall_depth}},
          2);
    }
    for (const double x : {0.0, site::width - 0.05}) {
      for (int i = 0; i < 3; ++i)
        add("wall end",
            {{x, band(site::hall_height, 0), i * 8.0}, {x + 0.05, band(site::hall_height, 1), i * 8.0 + 8}},
            0);
      for (int i = 0; i < site::strips; ++i) {
        const double z = site::hall_depth + i * site::strip;
        add("wall end", {{x, band(site::height, 0), z}, {x + 0.05, band(site::height, 1), z + site::strip}},
            0);
      }
    }
  }
  // Walls beside the boilers, between the aisles.
  for (int floor = 0; floor < site::storeys; ++floor)
    for (const double x : {10.0, 38.0, 58.0, 86.0})
      add("partition", {{x, floor * site::storey, 31}, {x + 0.05, (floor + 1) * site::storey - 0.6, 53}}, 0);
}

void add_floors(PlantObjects& objects, const PlantSite& site) {
  objects.push_back({"foundation", 12, [](uint64_t) {
                       Shape shape(concrete);
                       shape.box({0, -0.5, 0}, {site::width, 0, site::depth});
                       return shape;
                     }});
  for (int level = 1; level < site::storeys; ++level) {
    const double y = level * site::storey;
    for (int i = 0; i < site::bays; ++i) {
      for (int k = 0; k < site::strips; ++k) {
        const double x = i * site::bay, z = site::hall_depth + k * site::strip;
        const SiteBox area{{x + 0.02, y - 0.04, z + 0.02}, {x + site::bay - 0.02, y, z + site::strip - 0.02}};
        const bool inside = area.meets(site::boiler(0)) || area.meets(site::boiler(1));
        // What the boilers cut out leaves a rim; the bays beside the stairs stay open.
        if (inside) continue;
        objects.push_back({fmt::format("grating {} {} {}", level, i, k), 3600,
                           [area](uint64_t n) { return grating(area, n); }});
      }
    }
  }
  for (int i = 0; i < site::bays; ++i) {
    for (const double z : {0.0, 17.5}) {
      const SiteBox area{{i * site::bay, site::deck - 0.4, z}, {(i + 1) * site::bay, site::deck, z + 6.5}};
      objects.push_back({"deck", 12, [area](uint64_t) {
                           Shape shape(concrete);
                           shape.box(area.low, area.high);
                           return shape;
                         }});
    }
  }
  for (const auto& aisle : site::aisles()) {
    const bool along = aisle.high.x - aisle.low.x > 10;
    if (!along || aisle.low.y < 1) continue;
    for (const double z : {aisle.low.z, aisle.high.z}) {
      // Open where the aisle across comes in, and where people go to machines.
      for (int part = 0; part < 4; ++part) {
        const double out = z < 0.5 * (aisle.low.z + aisle.high.z) ? -0.05 : 0.05;
        const Point from(4 + part * 23, aisle.low.y, z + out), to = from + Point(19, 0, 0);
        const SiteBox box{from - Point(0.03, 0, 0.03), to + Point(0.03, 1.2, 0.03)};
        if (!site.in_aisle(box))
          objects.push_back({"railing", 2600, [from, to](uint64_t) { return railing(from, to); }});
      }
    }
  }
}

void add_roof(PlantObjects& objects) {
  for (int i = 0; i < site::bays; ++i) {
    for (const bool hall : {true, false}) {
      const double x = i * site::bay, y = hall ? site::hall_height : site::height,
                   z = hall ? 0 : site::hall_depth, far = hall ? site::hall_depth : site::depth;
      objects.push_back({"roof", 1500, [=](uint64_t) {
                           Shape shape(roofing);
                           shape.box({x, y, z}, {x + site::bay, y + 0.15, far});
                           add_beam(shape, {x + 0.2, y - 0.25, z}, {x + 0.2, y - 0.25, far});
                           add_beam(shape, {x + 0.2, y - 2.2, z}, {x + 0.2, y - 2.2, far});
                           for (double at = z; at + 3 <= far; at += 3) {
                             shape.tube({{x + 0.2, y - 2.2, at}, {x + 0.2, y - 0.3, at + 1.5}}, 0.06);
                             shape.tube({{x + 0.2, y - 0.3, at + 1.5}, {x + 0.2, y - 2.2, at + 3}}, 0.06);
                           }
                           return shape;
                         }});
    }
  }
}

}  // namespace

void add_structure(PlantObjects& objects, PlantSite& site) {
  for (int i = 0; i <= site::bays; ++i) {
    for (const double z : strip_lines) {
      const double x = std::clamp(i * site::bay, 0.5, site::width - 0.5), at = std::clamp(z, 0.5, 59.5);
      const double height = z == 0 ? site::hall_height : site::height;
      const SiteBox box{{x - 0.4, 0, at - 0.4}, {x + 0.4, height, at + 0.4}};
      if (!site.is_free(box)) continue;
      site.take(box);
      objects.push_back(
          {"column", 700, [x, at, height](uint64_t) {
             Shape shape(steel);
             add_column(shape, {x, 0, at}, height);
             for (int k = 0; k < 24; ++k)
               shape.bolt({x + 0.05 * (k % 6) + 0.08, 0.05, at + 0.1 * (k / 6 - 1.5)}, 0.02, 0.04);
             for (double y = site::storey; y < height; y += site::storey)
               shape.cylinder({x - 0.3, y - 0.7, at}, 0, 0.6, 0.05);
             return shape;
           }});
    }
  }
  for (int level = 1; level < site::storeys; ++level) {
    for (int i = 0; i <= site::bays; ++i) {
      const double x = std::clamp(i * site::bay, 0.3, site::width - 0.3), y = level * site::storey - 0.32;
      const bool boiler =
          SiteBox{{x - 0.2, y, 30}, {x + 0.2, y + 0.1, 54}}.meets(site::boiler(0).grown(0.3)) ||
          SiteBox{{x - 0.2, y, 30}, {x + 0.2, y + 0.1, 54}}.meets(site::boiler(1).grown(0.3));
      objects.push_back({"beam", 400, [=](uint64_t) {
                           Shape shape(steel);
                           add_beam(shape, {x, y, site::hall_depth}, {x, y, boiler ? 33.5 : site::depth});
                           if (boiler) add_beam(shape, {x, y, 50.5}, {x, y, site::depth});
                           for (const double z : {26.0, 31.0, 53.0, 58.0})
                             shape.cylinder({x - 0.15, y - 0.4, z}, 0, 0.3, 0.05);
                           return shape;
                         }});
    }
  }
  for (int level = 0; level + 1 < site::storeys; ++level) {
    for (const double x : {3.0, 87.0}) {
      const Point foot(x, level * site::storey, 25.2);
      site.take({foot, foot + Point(5.4, site::storey - 0.1, 2.2)});
      objects.push_back({"stairs", 1500, [foot](uint64_t) { return stairs(foot); }});
    }
  }
  add_floors(objects, site);
  add_walls(objects, site);
  add_roof(objects);
}

}  // namespace triptych
