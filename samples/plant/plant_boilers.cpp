#include "samples/plant/plant_parts.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {
namespace {

using Point = glm::dvec3;
const Point tube_steel(0.42, 0.26, 0.18), plate(0.38, 0.40, 0.42), green(0.12, 0.30, 0.22),
    blue(0.14, 0.24, 0.42), copper(0.55, 0.32, 0.16), concrete(0.45, 0.44, 0.42), red(0.45, 0.10, 0.07);

/// A wall of tubes side by side, with a bulge around the burners.
Shape water_wall(const SiteBox& boiler, int side, uint64_t triangles) {
  Shape shape(tube_steel);
  const int run = side < 2 ? 0 : 2, across = 2 - run;
  const double length = boiler.high[run] - boiler.low[run];
  const auto tubes = static_cast<int>(std::clamp<uint64_t>(triangles / 150, 4, 220));
  const double at = side % 2 == 0 ? boiler.low[across] + 0.4 : boiler.high[across] - 0.4;
  const double radius = std::min(0.3, 0.42 * length / tubes);
  for (int i = 0; i < tubes; ++i) {
    std::vector<Point> line;
    for (const auto& [share, out] :
         {std::pair{0.02, 0.3}, {0.12, 0.0}, {0.85, 0.0}, {0.90, 0.25}, {0.97, 0.25}}) {
      Point point;
      point[run] = boiler.low[run] + (i + 0.5) * length / tubes;
      point[across] = at + (side % 2 == 0 ? out : -out);
      point.y = glm::mix(boiler.low.y, boiler.high.y, share);
      line.push_back(point);
    }
    shape.tube(line, radius);
  }
  return shape;
}

/// A hanging loop of superheater tubes.
Shape platen(const Point& top, uint64_t triangles) {
  Shape shape(copper);
  const auto loops = static_cast<int>(std::clamp<uint64_t>(triangles / 400, 2, 60));
  for (int i = 0; i < loops; ++i) {
    const double half = 0.15 + 4.5 * (i + 1.0) / loops, down = 3 + 6.0 * (i + 1) / loops;
    shape.tube({top + Point(-half, 0, 0), top + Point(-half, -down, 0), top + Point(half, -down, 0),
                top + Point(half, 0, 0)},
               std::min(0.04, 2.0 / loops));
  }
  return shape;
}

void add_boiler(PlantObjects& objects, const SiteBox& box) {
  const Point middle = 0.5 * (box.low + box.high);
  for (int side = 0; side < 4; ++side)
    objects.push_back({"water wall", 280'000, [=](uint64_t n) { return water_wall(box, side, n); }});
  for (int i = 0; i < 8; ++i)
    objects.push_back({"superheater", 60'000, [=](uint64_t n) {
                         return platen({middle.x, box.high.y - 2, box.low.z + 1.5 + 1.6 * i}, n);
                       }});
  objects.push_back(
      {"drum", 30'000, [=](uint64_t) {
         Shape shape(plate);
         const double half = 6.5;
         shape.turned({middle.x - half, box.high.y + 0.7, box.low.z + 2}, 0,
                      {{0, 0.15},
                       {0.1, 0.6},
                       {0.35, 0.95},
                       {0.8, 1.1},
                       {2 * half - 0.8, 1.1},
                       {2 * half - 0.35, 0.95},
                       {2 * half - 0.1, 0.6},
                       {2 * half, 0.15}});
         for (int i = 0; i < 24; ++i)
           shape.cylinder({middle.x - 6 + 0.5 * i, box.high.y - 0.8, box.low.z + 1.6}, 1, 0.7, 0.06);
         return shape;
       }});
  for (int side = 0; side < 4; ++side) {
    for (const double height : {0.02, 0.97}) {
      objects.push_back({"header", 6'000, [=](uint64_t) {
                           Shape shape(plate);
                           const int run = side < 2 ? 0 : 2, across = 2 - run;
                           Point from = box.low;
                           from.y = glm::mix(box.low.y, box.high.y, height);
                           from[across] = side % 2 == 0 ? box.low[across] + 0.5 : box.high[across] - 0.5;
                           const double length = box.high[run] - box.low[run];
                           shape.cylinder(from, run, length, 0.28);
                           for (int i = 0; i < 12; ++i) {
                             Point stub = from;
                             stub[run] += (i + 0.5) * length / 12;
                             shape.cylinder(stub + Point(0, -0.5, 0), 1, 1.0, 0.08);
                           }
                           return shape;
                         }});
    }
  }
  // Buckstays: belts of beams that hold the walls, outside.
  for (int i = 0; i < 9; ++i) {
    objects.push_back(
        {"buckstay", 400, [=](uint64_t) {
           Shape shape(green);
           const double y = box.low.y + 4 + 4 * i, out = 0.1;
           const Point a(box.low.x - out, y, box.low.z - out), b(box.high.x + out, y, box.low.z - out),
               c(box.high.x + out, y, box.high.z + out), d(box.low.x - out, y, box.high.z + out);
           const Point corners[] = {a, b, c, d, a};
           for (int k = 0; k < 4; ++k)
             for (const double up : {-0.25, 0.0, 0.25})
               shape.bar(corners[k] + Point(0, up, 0), corners[k + 1] + Point(0, up, 0), up == 0 ? 0.02 : 0.3,
                         up == 0 ? 0.5 : 0.03, k % 2 ? Point(1, 0, 0) : Point(0, 0, 1));
           return shape;
         }});
  }
  for (int i = 0; i < 12; ++i) {
    objects.push_back(
        {"burner", 4'000, [=](uint64_t) {
           Shape shape(red);
           const bool back = i % 2 == 1;
           const double out = back ? 1 : -1;
           const Point at(middle.x - 5 + 5.0 * (i / 2 % 3), i < 6 ? 10.2 : 16.2,
                          back ? box.high.z : box.low.z);
           shape.turned(at + Point(0, 0, out * 0.1), 2,
                        {{0, 0.55},
                         {out * 0.4, 0.6},
                         {out * 0.45, 0.8},
                         {out * 0.55, 0.8},
                         {out * 0.6, 0.4},
                         {out * 1.6, 0.3}});
           shape.tube(
               {at + Point(0, 0, out * 1.2), at + Point(0, 0.9, out * 1.2), at + Point(0.9, 0.9, out * 1.2)},
               0.12);
           for (int k = 0; k < 8; ++k)
             shape.bolt(at + Point(0.7 * std::cos(k * 0.785), 0.7 * std::sin(k * 0.785), out * 0.7), 0.04,
                        0.05);
           return shape;
         }});
  }
}

void add_turbine(PlantObjects& objects, const SiteBox& box) {
  const double axis = box.low.y + 1.9, z = 0.5 * (box.low.z + box.high.z), x = box.low.x;
  const auto casing = [&](const char* name, double from, double length, double radius, const Point& colour,
                          double weight) {
    objects.push_back(
        {name, weight, [=](uint64_t) {
           Shape shape(colour);
           shape.turned({x + from, axis, z}, 0,
                        {{0, 0.5},
                         {0.2, 0.55 * radius},
                         {0.25 * length, radius},
                         {0.48 * length, radius},
                         {0.481 * length, radius + 0.12},
                         {0.519 * length, radius + 0.12},
                         {0.52 * length, radius},
                         {0.75 * length, radius},
                         {length - 0.2, 0.55 * radius},
                         {length, 0.5}});
           // The joint between the halves, with its bolts.
           shape.box({x + from + 0.3, axis - 0.12, z - radius - 0.25},
                     {x + from + length - 0.3, axis + 0.12, z + radius + 0.25});
           for (int i = 0; i < 30; ++i)
             for (const double side : {-1.0, 1.0})
               shape.bolt({x + from + 0.5 + (length - 1) * i / 29, axis + 0.12, z + side * (radius + 0.13)},
                          0.06, 0.16);
           for (int i = 0; i < 8; ++i)
             shape.cylinder(
                 {x + from + 0.8 + (length - 1.6) * i / 7, axis - 1.6, z + (i % 2 ? 0.6 : -0.6) * radius}, 1,
                 1.6, 0.18);
           return shape;
         }});
  };
  casing("high pressure turbine", 1, 5, 1.2, plate, 60'000);
  casing("intermediate turbine", 7, 6, 1.6, plate, 70'000);
  casing("low pressure turbine", 14, 8, 2.5, blue, 120'000);
  casing("generator", 23.5, 8, 1.9, green, 90'000);
  casing("exciter", 32.2, 2.5, 0.8, green, 20'000);
  objects.push_back({"shaft", 8'000, [=](uint64_t) {
                       Shape shape(plate);
                       shape.cylinder({x + 0.3, axis, z}, 0, 34, 0.3);
                       return shape;
                     }});
  for (int i = 0; i < 6; ++i) {
    objects.push_back({"bearing", 5'000, [=](uint64_t) {
                         Shape shape(blue);
                         const double at =
                             x + std::array{0.6, 6.5, 13.5, 22.7, 31.8, 34.6}[static_cast<size_t>(i)];
                         shape.box({at - 0.35, box.low.y, z - 0.7}, {at + 0.35, axis, z + 0.7});
                         shape.cylinder({at - 0.4, axis, z}, 0, 0.8, 0.6);
                         return shape;
                       }});
  }
  for (int i = 0; i < 6; ++i) {
    objects.push_back(
        {"pedestal", 24, [=](uint64_t) {
           Shape shape(concrete);
           const double at = x + 1 + 6.4 * i;
           shape.box({at - 0.7, 0, box.low.z}, {at + 0.7, site::deck - 0.02, box.low.z + 1.4});
           shape.box({at - 0.7, 0, box.high.z - 1.4}, {at + 0.7, site::deck - 0.02, box.high.z});
           return shape;
         }});
  }
  objects.push_back({"turbine foundation", 36, [=](uint64_t) {
                       Shape shape(concrete);
                       shape.box({x, site::deck - 1, box.low.z}, {x + 13, site::deck, box.high.z});
                       shape.box({x + 23, site::deck - 1, box.low.z}, {x + 35, site::deck, box.high.z});
                       return shape;
                     }});
  // Below: a condenser, a shell full of tubes with its ends open.
  objects.push_back(
      {"condenser tubes", 260'000, [=](uint64_t triangles) {
         Shape shape(copper);
         const auto rows =
             static_cast<int>(std::sqrt(static_cast<double>(std::clamp<uint64_t>(triangles / 100, 4, 2000))));
         for (int i = 0; i < rows; ++i)
           for (int k = 0; k < rows; ++k)
             shape.cylinder({x + 15 + 6.0 * (i + 0.5) / rows, 2 + 4.5 * (k + 0.5) / rows, box.low.z + 1.6}, 2,
                            box.high.z - box.low.z - 3.2, std::min(0.1, 1.6 / rows));
         return shape;
       }});
  objects.push_back({"condenser shell", 2'000, [=](uint64_t) {
                       Shape shape(blue);
                       for (const double side : {14.6, 21.2})
                         shape.box({x + side, 1, box.low.z + 1.5}, {x + side + 0.2, 7.5, box.high.z - 1.5});
                       shape.box({x + 14.6, 1, box.low.z + 1.5}, {x + 21.4, 1.2, box.high.z - 1.5});
                       shape.box({x + 14.6, 7.3, box.low.z + 1.5}, {x + 21.4, 7.5, box.high.z - 1.5});
                       for (int i = 0; i < 10; ++i)
                         shape.cylinder({x + 14.4, 1.3 + 0.6 * i, box.low.z + 1.4}, 0, 7.2, 0.12);
                       return shape;
                     }});
}

}  // namespace

void add_boilers(PlantObjects& objects) {
  for (int i = 0; i < site::boilers; ++i) add_boiler(objects, site::boiler(i));
}

void add_turbines(PlantObjects& objects) {
  for (int i = 0; i < site::turbines; ++i) add_turbine(objects, site::turbine(i));
}

}  // namespace triptych
