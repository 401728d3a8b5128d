#include "samples/plant/plant_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using Point = glm::dvec3;
const Point grey(0.45, 0.47, 0.48), blue(0.12, 0.28, 0.50), green(0.14, 0.34, 0.20), orange(0.62, 0.30, 0.06),
    white(0.72, 0.72, 0.68), dark(0.12, 0.12, 0.13), silver(0.58, 0.60, 0.62), brown(0.30, 0.20, 0.13);

/// A round flange with its bolts, on an axis.
void add_flange(Shape& shape, const Point& place, int axis, double radius) {
  shape.cylinder(place, axis, 0.05, radius);
  for (int i = 0; i < 8; ++i) {
    const double turn = glm::two_pi<double>() * i / 8;
    Point at = place;
    at[(axis + 1) % 3] += 0.82 * radius * std::cos(turn);
    at[(axis + 2) % 3] += 0.82 * radius * std::sin(turn);
    shape.bolt(at, 0.02, 0.07);
  }
}

Shape tank(const Point& foot, double radius, double height, bool lying) {
  Shape shape(white);
  const double end = 0.25 * radius;
  const std::vector<glm::dvec2> profile{
      {0, 0.2 * radius},      {0.4 * end, 0.7 * radius},          {end, radius},
      {height - end, radius}, {height - 0.4 * end, 0.7 * radius}, {height, 0.2 * radius}};
  const Point base = lying ? foot + Point(-height / 2, radius + 0.5, 0) : foot + Point(0, 0.4, 0);
  shape.turned(base, lying ? 0 : 1, profile);
  for (int i = 0; i < 4; ++i) {
    const Point leg = lying ? Point((i / 2 - 0.5) * 0.6 * height, 0, (i % 2 - 0.5) * radius)
                            : Point((i / 2 - 0.5) * radius, 0, (i % 2 - 0.5) * radius);
    shape.box(foot + leg - Point(0.1, 0, 0.1), foot + leg + Point(0.1, 0.9, 0.1));
  }
  for (int i = 0; i < 4; ++i)
    add_flange(shape,
               lying ? base + Point(height * (0.2 + 0.2 * i), radius, 0)
                     : base + Point(radius, height * (0.2 + 0.2 * i), 0),
               lying ? 1 : 0, 0.15);
  return shape;
}

Shape pump(const Point& foot, double size) {
  Shape shape(blue);
  shape.cylinder(foot + Point(-0.9, 0.6, 0) * size, 0, 0.9 * size, 0.34 * size);
  shape.turned(
      foot + Point(0.35, 0.6, 0) * size, 0,
      {{0, 0.2 * size}, {0.05 * size, 0.42 * size}, {0.3 * size, 0.45 * size}, {0.5 * size, 0.18 * size}});
  shape.box(foot + Point(-1, 0, -0.4) * size, foot + Point(1, 0.15, 0.4) * size);
  shape.cylinder(foot + Point(0, 0.6, 0) * size, 0, 0.4 * size, 0.07 * size);
  for (int i = 0; i < 24; ++i) {  // the motor's cooling fins
    const double turn = glm::two_pi<double>() * i / 24;
    const Point out(0, std::cos(turn), std::sin(turn)),
        from = foot + Point(-0.85, 0.6, 0) * size + out * 0.36 * size;
    shape.bar(from, from + Point(0.75, 0, 0) * size, 0.015 * size, 0.06 * size,
              glm::cross(Point(1, 0, 0), out));
  }
  shape.tube(
      {foot + Point(0.5, 0.9, 0) * size, foot + Point(0.5, 1.5, 0) * size, foot + Point(0.95, 1.5, 0) * size},
      0.14 * size);
  add_flange(shape, foot + Point(0.95, 1.5, 0) * size, 0, 0.22 * size);
  for (int i = 0; i < 4; ++i)
    shape.bolt(foot + Point(i / 2 ? 0.9 : -0.9, 0.15 / size, i % 2 ? 0.32 : -0.32) * size, 0.03, 0.05);
  return shape;
}

Shape valve(const Point& foot, double size) {
  Shape shape(orange);
  const Point middle = foot + Point(0, 0.6, 0) * size;
  shape.turned(middle - Point(0.35, 0, 0) * size, 0,
               {{0, 0.14 * size},
                {0.15 * size, 0.14 * size},
                {0.35 * size, 0.26 * size},
                {0.55 * size, 0.14 * size},
                {0.7 * size, 0.14 * size}});
  shape.turned(middle, 1,
               {{0, 0.16 * size},
                {0.35 * size, 0.12 * size},
                {0.36 * size, 0.2 * size},
                {0.42 * size, 0.2 * size},
                {0.43 * size, 0.03 * size},
                {0.8 * size, 0.03 * size}});
  std::vector<Point> wheel;
  for (int i = 0; i <= 16; ++i) {
    const double turn = glm::two_pi<double>() * i / 16;
    wheel.push_back(middle + size * Point(0.3 * std::cos(turn), 0.8, 0.3 * std::sin(turn)));
  }
  shape.tube(wheel, 0.025 * size);
  for (const double side : {-0.4, 0.35}) add_flange(shape, middle + Point(side, 0, 0) * size, 0, 0.24 * size);
  shape.bar(middle + Point(-0.3, 0.8, 0) * size, middle + Point(0.3, 0.8, 0) * size, 0.03, 0.03);
  shape.box(foot - Point(0.1, 0, 0.1), foot + Point(0.1, 0.45 * size, 0.1));
  return shape;
}

Shape exchanger(const Point& foot) {
  Shape shape(silver);
  shape.turned(foot + Point(-2.2, 1.1, 0), 0,
               {{0, 0.6},
                {0.4, 0.7},
                {0.41, 0.85},
                {0.5, 0.85},
                {0.51, 0.7},
                {3.9, 0.7},
                {3.91, 0.85},
                {4.0, 0.85},
                {4.01, 0.7},
                {4.4, 0.3}});
  for (const double at : {-1.3, 1.3})
    shape.box(foot + Point(at - 0.15, 0, -0.6), foot + Point(at + 0.15, 0.6, 0.6));
  for (const double at : {-1.5, 0.0, 1.4})
    shape.tube({foot + Point(at, 1.7, 0), foot + Point(at, 2.3, 0), foot + Point(at, 2.3, 0.6)}, 0.12);
  return shape;
}

Shape cabinet(const Point& foot) {
  Shape shape(grey);
  shape.box(foot - Point(0.8, 0, 0.3), foot + Point(0.8, 2.1, 0.3));
  for (int i = 0; i < 40; ++i) {
    const Point at = foot + Point(-0.7 + 0.35 * (i % 5), 0.4 + 0.2 * (i / 5), 0.3);
    shape.box(at, at + Point(0.2, 0.08, 0.02));
  }
  return shape;
}

Shape mill(const Point& foot) {
  Shape shape(green);
  shape.turned(foot, 1, {{0, 1.6}, {0.4, 1.6}, {0.5, 1.3}, {2.4, 1.5}, {3.2, 1.5}, {4.2, 0.7}, {5.2, 0.5}});
  for (int i = 0; i < 5; ++i) {
    const double turn = glm::two_pi<double>() * i / 5;
    const Point out(std::cos(turn), 0, std::sin(turn));
    shape.tube({foot + out * 0.4 + Point(0, 4.3, 0), foot + out * 1.2 + Point(0, 5.1, 0)}, 0.2);
    shape.cylinder(foot + out * 1.5 + Point(0, 0.4, 0), 1, 1.8, 0.15);
  }
  return shape;
}

Shape fan(const Point& foot) {
  Shape shape(grey);
  shape.cylinder(foot + Point(-0.7, 1.6, 0), 0, 1.4, 1.5);
  shape.box(foot + Point(-0.6, 1.6, 0.2), foot + Point(0.6, 3.0, 1.6));
  shape.cylinder(foot + Point(0.7, 1.6, 0), 0, 1.2, 0.2);
  shape.box(foot + Point(-0.9, 0, -1), foot + Point(0.9, 0.3, 1));
  return shape;
}

/// A ladder of rungs under a ceiling, full of cables; along x.
Shape cable_tray(const Point& from, double length, uint64_t triangles, Random random) {
  Shape shape(dark);
  const double wide = 0.5;
  for (const double side : {0.0, wide})
    shape.bar(from + Point(0, 0, side), from + Point(length, 0, side), 0.015, 0.1);
  const auto cables = static_cast<int>(std::clamp<uint64_t>(triangles / 250, 1, 40));
  for (int i = 0; i < cables; ++i) {
    std::vector<Point> line;
    const double z = from.z + wide * (i + 0.5) / cables;
    for (double x = 0; x <= length; x += 1.5)
      line.push_back({from.x + x, from.y + 0.03 + random.between(0, 0.06), z + random.between(-0.02, 0.02)});
    shape.tube(line, 0.012);
  }
  for (double x = 0; x < length; x += 0.3)
    shape.bar(from + Point(x, 0, 0), from + Point(x, 0, wide), 0.03, 0.015, Point(1, 0, 0));
  return shape;
}

/// A rectangular duct with stiffening frames.
Shape duct(const std::vector<Point>& line, double size) {
  Shape shape(silver);
  for (size_t i = 1; i < line.size(); ++i) {
    const Point along = glm::normalize(line[i] - line[i - 1]);
    const Point side = std::abs(along.z) > 0.5 ? Point(1, 0, 0) : Point(0, 0, 1);
    const Point reach = along * (size / 2);
    shape.bar(line[i - 1] - reach, line[i] + reach, size, size, side);
  }
  for (size_t i = 1; i < line.size(); ++i) {
    const double length = glm::distance(line[i], line[i - 1]);
    const Point along = (line[i] - line[i - 1]) / length;
    const Point side = std::abs(along.z) > 0.5 ? Point(1, 0, 0) : Point(0, 0, 1);
    for (double at = 0.8; at < length; at += 0.8)
      shape.bar(line[i - 1] + along * (at - 0.04), line[i - 1] + along * (at + 0.04), size + 0.16,
                size + 0.16, side);
  }
  return shape;
}

void add_ducts(PlantObjects& objects, PlantSite& site) {
  for (int i = 0; i < site::boilers; ++i) {
    const SiteBox box = site::boiler(i);
    for (int k = 0; k < 8; ++k) {
      // From the boiler's side, above head height, to a riser at the wall.
      const double sign = k % 2 == 0 ? -1 : 1, y = 4.2 + 6 * (k / 2), z = 37 + 3.2 * (k / 2);
      const double wall = sign < 0 ? box.low.x : box.high.x;
      const std::vector<Point> line{{wall, y, z}, {wall + sign * 3, y, z}, {wall + sign * 3, y + 14 - k, z}};
      site.take({{std::min(wall, wall + sign * 3.8), y - 0.8, z - 0.8},
                 {std::max(wall, wall + sign * 3.8), y + 14.8 - k, z + 0.8}});
      objects.push_back({"duct", 700, [line](uint64_t) { return duct(line, 1.4); }});
    }
  }
  for (int i = 0; i < 4; ++i) {
    const double y = 9.2 + 12 * (i / 2), z = i % 2 ? 52.6 : 32.0;
    objects.push_back({"duct", 1'500, [=](uint64_t) {
                         return duct({{4, y, z}, {44, y, z}, {44, y + 1.8, z}, {90, y + 1.8, z}}, 1.3);
                       }});
  }
}

}  // namespace

void add_machines(PlantObjects& objects, PlantSite& site, Random random) {
  add_ducts(objects, site);
  const auto add = [&](const char* name, int count, double weight, const Point& size, auto make) {
    for (int i = 0; i < count; ++i) {
      const Point foot = site.place(size);
      const double luck = random.uniform();
      objects.push_back({name, weight * (0.4 + 1.2 * luck), [=](uint64_t) { return make(foot, luck); }});
    }
  };
  add("mill", 8, 20'000, {3.6, 5.4, 3.6}, [](Point foot, double) { return mill(foot); });
  add("fan", 6, 15'000, {3, 3.4, 3.4}, [](Point foot, double) { return fan(foot); });
  add("tank", 24, 14'000, {5.4, 4.8, 2.8}, [](Point foot, double luck) {
    return tank(foot, 0.7 + 0.6 * luck, luck < 0.5 ? 4.0 : 5.0, luck >= 0.5);
  });
  add("heat exchanger", 16, 12'000, {5, 2.6, 2}, [](Point foot, double) { return exchanger(foot); });
  add("pump", 50, 8'000, {2.4, 2, 1.2}, [](Point foot, double luck) { return pump(foot, 0.7 + 0.4 * luck); });
  add("cabinet", 30, 500, {1.8, 2.2, 1}, [](Point foot, double) { return cabinet(foot); });
  add("valve", 70, 6'000, {1.1, 1.6, 1},
      [](Point foot, double luck) { return valve(foot, 0.6 + 0.5 * luck); });
  for (int i = 0; i < 60; ++i) {
    const int level = i % site::storeys;
    const bool near = i / site::storeys % 2 == 0;
    const Point from(2 + 10.0 * (i / site::storeys), level * site::storey + 3 + 0.3 * (i % 5),
                     near ? 28.2 + 0.6 * (i % 2) : 54.8 + 0.6 * (i % 2));
    const Random stream = random.fork(static_cast<uint64_t>(i));
    objects.push_back({"cable tray", 9'000, [=](uint64_t n) { return cable_tray(from, 9.4, n, stream); }});
  }
  for (int i = 0; i < 28; ++i) {
    const Point at(4 + 9.5 * (i % 10), site::storey * (1 + i / 10) - 0.9, i % 2 ? 29.0 : 55.5);
    objects.push_back({"lamp", 600, [at](uint64_t) {
                         Shape shape(white);
                         shape.turned(at, 1, {{0, 0.28}, {0.1, 0.25}, {0.25, 0.1}, {0.3, 0.03}, {0.6, 0.03}});
                         return shape;
                       }});
  }
  for (int i = 0; i < 50; ++i) {
    const Point at = site.place({0.3, 0.2, 0.3});
    objects.push_back({"bolt", 20, [at](uint64_t) {
                         Shape shape(dark);
                         shape.bolt(at, 0.06, 0.09);
                         return shape;
                       }});
  }
  for (int i = 0; i < 6; ++i) {  // coal bunkers, under the roof
    const double x = 42 + 2.4 * i, z = 36 + 2.6 * (i % 3);
    objects.push_back({"bunker", 4'000, [=](uint64_t) {
                         Shape shape(brown);
                         shape.turned({x, 37.2, z}, 1, {{0, 0.3}, {2.5, 1.15}, {7.5, 1.15}});
                         return shape;
                       }});
  }
  objects.push_back({"crane", 3'000, [](uint64_t) {
                       Shape shape(orange);
                       for (const double x : {46.0, 48.5}) shape.box({x, 23, 0.8}, {x + 0.5, 24.4, 23.2});
                       for (const double z : {0.7, 22.8}) shape.box({44, 22.6, z}, {51, 23, z + 0.5});
                       shape.box({46, 24.4, 10}, {49, 25.6, 13});
                       shape.tube({{47.5, 24.5, 11.5}, {47.5, 19, 11.5}}, 0.04);
                       shape.turned({47.5, 18.2, 11.5}, 1, {{0, 0.1}, {0.2, 0.3}, {0.6, 0.3}, {0.8, 0.1}});
                       for (const double z : {0.9, 23.0})
                         shape.box({0.6, 22.2, z - 0.2}, {95.4, 22.6, z + 0.2});
                       return shape;
                     }});
}

}  // namespace triptych
