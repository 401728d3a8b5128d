#include "samples/services/pipe_parts.hpp"

#include "samples/services/part_tools.hpp"
#include "samples/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

const glm::dvec3 steel(0.42, 0.44, 0.46), brass(0.55, 0.40, 0.12), wool(0.50, 0.51, 0.50),
    red(0.55, 0.05, 0.04), blue(0.06, 0.14, 0.45);

double wall_of(double diameter) { return std::clamp(diameter * 0.08, 0.001, 0.006); }

}  // namespace

MeshParts pipe(const glm::dvec3& colour, double diameter, double length) {
  MeshPart part = part_of(colour);
  add_tube(part, 0, length, diameter / 2, diameter / 2 - wall_of(diameter), sides_of(diameter));
  return {part};
}

double pipe_elbow_radius(double diameter) { return 1.5 * diameter; }

MeshParts pipe_elbow(const glm::dvec3& colour, double diameter) {
  MeshPart part = part_of(colour);
  const size_t sides = sides_of(diameter);
  add_hollow(part, bend_frames(pipe_elbow_radius(diameter), 6), circle_profile(diameter / 2, sides),
             circle_profile(diameter / 2 - wall_of(diameter), sides));
  return {part};
}

MeshParts pipe_tee(const glm::dvec3& colour, double diameter, double branch) {
  MeshPart part = part_of(colour);
  const size_t sides = sides_of(diameter);
  add_tube(part, -1.2 * branch, 1.2 * branch, diameter * 0.54, diameter / 2, sides);
  add_turned(part, {0, 0, 0}, 1, {{0.3 * diameter, branch * 0.54}, {diameter / 2 + branch, branch * 0.54}},
             sides_of(branch));
  return {part};
}

MeshParts pipe_joint(const glm::dvec3& colour, double diameter) {
  MeshPart part = part_of(colour);
  const size_t sides = sides_of(diameter);
  if (diameter < 0.08) {
    // A press fitting: its ends bulge over their seals.
    std::vector<Outline> outlines;
    const auto add_ring = [&](double along, double radius) {
      SweepFrame frame;
      frame.centre.x = along * diameter;
      outlines.push_back(placed_outline(frame, circle_profile(radius * diameter, sides)));
    };
    for (const auto& [along, radius] : {std::pair{-0.9, 0.56},
                                        {-0.75, 0.63},
                                        {-0.6, 0.56},
                                        {0.6, 0.56},
                                        {0.75, 0.63},
                                        {0.9, 0.56},
                                        {0.9, 0.5},
                                        {-0.9, 0.5}})
      add_ring(along, radius);
    add_looped(part, outlines);
    return {part};
  }
  MeshPart bolts = part_of(steel);
  const double radius = diameter / 2 + 0.045;
  add_tube(part, -0.02, -0.002, radius, diameter / 2 - 0.001, sides);
  add_tube(part, 0.002, 0.02, radius, diameter / 2 - 0.001, sides);
  constexpr int count = 8;
  for (int i = 0; i < count; ++i) {
    const double turn = glm::two_pi<double>() * (i + 0.5) / count, r = diameter / 2 + 0.025;
    const glm::dvec3 at(0, r * std::cos(turn), r * std::sin(turn));
    add_rod(bolts, at - glm::dvec3(0.035, 0, 0), at + glm::dvec3(0.035, 0, 0), 0.009, 6);
  }
  return {part, bolts};
}

MeshParts pipe_insulation(double diameter, double length) {
  MeshPart part = part_of(wool);
  const double thickness = diameter < 0.05 ? 0.02 : 0.03;
  add_tube(part, 0, length, diameter / 2 + thickness, diameter / 2 + 0.001,
           std::max<size_t>(12, sides_of(diameter)));
  return {part};
}

MeshParts pipe_clamp(double diameter, double rod) {
  MeshPart part = part_of(steel);
  add_tube(part, -0.012, 0.012, diameter / 2 + 0.006, diameter / 2 + 0.0005, sides_of(diameter));
  for (const double side : {-1.0, 1.0})
    add_box(part, {-0.012, -0.006, side * (diameter / 2 + 0.012) - 0.008},
            {0.012, 0.006, side * (diameter / 2 + 0.012) + 0.008});
  add_hanger_rod(part, {0, diameter / 2 + 0.003, 0}, rod - diameter / 2);
  return {part};
}

MeshParts pipe_bracket(double diameter) {
  MeshPart part = part_of(steel);
  constexpr double reach = 0.06;
  add_tube(part, -0.012, 0.012, diameter / 2 + 0.006, diameter / 2 + 0.0005, sides_of(diameter));
  add_rod(part, {0, -diameter / 2 - 0.003, 0}, {0, -diameter / 2 - reach, 0}, 0.006, 6);
  add_box(part, {-0.025, -diameter / 2 - reach - 0.005, -0.02}, {0.025, -diameter / 2 - reach, 0.02});
  return {part};
}

MeshParts trapeze(double length, double rods) {
  MeshPart part = part_of(steel);
  add_box(part, {-0.02, -0.04, -length / 2}, {0.02, -0.036, length / 2});
  for (const double x : {-0.02, 0.016}) add_box(part, {x, -0.036, -length / 2}, {x + 0.004, 0, length / 2});
  for (const double z : {-length / 2 + 0.02, length / 2 - 0.02}) {
    add_hanger_rod(part, {0, -0.06, z}, rods + 0.06);
    add_box(part, {-0.03, rods - 0.008, z - 0.02}, {0.03, rods, z + 0.02});
  }
  return {part};
}

MeshParts gate_valve(double diameter) {
  MeshPart body = part_of(blue), wheel = part_of(red), stem = part_of(steel);
  const double d = diameter;
  const size_t sides = sides_of(d);
  add_turned(body, {-1.2 * d, 0, 0}, 0,
             {{0, 0.9 * d},
              {0.25 * d, 0.9 * d},
              {0.26 * d, 0.6 * d},
              {1.2 * d, 0.85 * d},
              {2.14 * d, 0.6 * d},
              {2.15 * d, 0.9 * d},
              {2.4 * d, 0.9 * d}},
             sides);
  add_turned(body, {0, 0.6 * d, 0}, 1, {{0, 0.55 * d}, {0.9 * d, 0.4 * d}}, 8);
  add_rod(stem, {0, 1.4 * d, 0}, {0, 2.6 * d, 0}, 0.12 * d, 6);
  add_torus(wheel, {0, 2.4 * d, 0}, 1, 0.75 * d, 0.08 * d, 10, 5);
  add_rod(wheel, {-0.75 * d, 2.4 * d, 0}, {0.75 * d, 2.4 * d, 0}, 0.06 * d, 5);
  return {body, wheel, stem};
}

MeshParts ball_valve(double diameter) {
  MeshPart body = part_of(brass), lever = part_of(red);
  const double d = diameter;
  add_turned(body, {-1.5 * d, 0, 0}, 0,
             {{0, 0.75 * d},
              {0.6 * d, 0.75 * d},
              {0.9 * d, 0.95 * d},
              {2.1 * d, 0.95 * d},
              {2.4 * d, 0.75 * d},
              {3 * d, 0.75 * d}},
             8);
  add_rod(body, {0, 0.8 * d, 0}, {0, 1.5 * d, 0}, 0.3 * d, 6);
  add_box(lever, {-0.2 * d, 1.45 * d, -0.3 * d}, {4 * d, 1.6 * d, 0.3 * d});
  return {body, lever};
}

MeshParts pressure_gauge() {
  MeshPart body = part_of(steel), face = part_of({0.85, 0.85, 0.82});
  add_rod(body, {0, 0, 0}, {0, 0.08, 0}, 0.008, 6);
  add_turned(body, {0, 0.13, -0.02}, 2, {{0, 0.05}, {0.03, 0.05}}, 12);
  add_turned(face, {0, 0.13, 0.01}, 2, {{0, 0.044}, {0.003, 0.044}}, 12);
  return {body, face};
}

MeshParts pump(double size) {
  MeshPart body = part_of(blue), motor = part_of({0.08, 0.25, 0.14}), base = part_of(steel);
  add_box(base, {-size, 0, -0.7 * size}, {size, 0.15 * size, 1.3 * size});
  add_turned(
      body, {0, 0.8 * size, -0.4 * size}, 2,
      {{0, 0.3 * size}, {0.05 * size, 0.5 * size}, {0.4 * size, 0.5 * size}, {0.5 * size, 0.25 * size}}, 16);
  add_turned(motor, {0, 0.8 * size, 0.1 * size}, 2, {{0, 0.33 * size}, {1.1 * size, 0.33 * size}}, 12);
  constexpr int fins = 10;
  for (int i = 0; i < fins; ++i) {
    const double z = size * (0.2 + 0.9 * i / fins);
    add_box(motor, {-0.4 * size, 0.5 * size, z}, {0.4 * size, 1.2 * size, z + 0.02 * size});
  }
  add_rod(body, {-size, 0.8 * size, -0.2 * size}, {size, 0.8 * size, -0.2 * size}, 0.2 * size, 12);
  return {body, motor, base};
}

MeshParts tank(double diameter, double height) {
  MeshPart body = part_of({0.60, 0.62, 0.64}), legs = part_of(steel);
  const double r = diameter / 2, bottom = 0.25;
  add_turned(body, {0, bottom, 0}, 1,
             {{0, 0.35 * r},
              {0.06 * height, 0.8 * r},
              {0.14 * height, r},
              {0.8 * height, r},
              {0.9 * height, 0.8 * r},
              {0.96 * height, 0.35 * r}},
             16);
  for (int i = 0; i < 4; ++i) {
    const double x = (i % 2 ? 0.6 : -0.6) * r, z = (i / 2 ? 0.6 : -0.6) * r;
    add_rod(legs, {x, 0, z}, {x, bottom + 0.1 * height, z}, 0.03, 6);
  }
  for (const double y : {0.3, 0.6})
    add_rod(legs, {0, bottom + y * height, r - 0.01}, {0, bottom + y * height, r + 0.12}, 0.04, 12);
  return {body, legs};
}

}  // namespace triptych
