#include "samples/services/fixture_parts.hpp"

#include "samples/services/part_tools.hpp"
#include "samples/sweep.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {
namespace {

const glm::dvec3 white(0.80, 0.80, 0.78), light(0.95, 0.94, 0.85), steel(0.42, 0.44, 0.46),
    dark(0.10, 0.10, 0.11), brass(0.55, 0.40, 0.12), red(0.55, 0.05, 0.04), galvanised(0.52, 0.54, 0.55),
    cable(0.09, 0.09, 0.10);

/// A frame that lies flat: along y.
void add_flat_frame(MeshPart& part, double y0, double y1, const glm::dvec2& outer, const glm::dvec2& inner) {
  const auto outline = [](double y, const glm::dvec2& size) {
    return placed_outline({{0, y, 0}, {0, 0, 1}, {1, 0, 0}}, rectangle_profile(size.y, size.x));
  };
  add_looped(part, {outline(y0, outer), outline(y1, outer), outline(y1, inner), outline(y0, inner)});
}

}  // namespace

MeshParts luminaire(double width, double depth) {
  MeshPart body = part_of(white), lamp = part_of(light), louvres = part_of(galvanised);
  add_flat_frame(body, 0, 0.09, {width, depth}, {width - 0.05, depth - 0.05});
  add_box(body, {-width / 2, 0.09, -depth / 2}, {width / 2, 0.1, depth / 2});
  const bool along = width >= depth;
  const double length = std::max(width, depth), across = std::min(width, depth);
  const int tubes = across > 0.4 ? 3 : 1;
  for (int i = 0; i < tubes; ++i) {
    const double at = across * ((i + 0.5) / tubes - 0.5), half = length / 2 - 0.05;
    add_rod(lamp, along ? glm::dvec3(-half, 0.06, at) : glm::dvec3(at, 0.06, -half),
            along ? glm::dvec3(half, 0.06, at) : glm::dvec3(at, 0.06, half), 0.013, 8);
  }
  const int count = static_cast<int>(length / 0.12);
  for (int i = 0; i < count; ++i) {
    const double at = length * ((i + 0.5) / count - 0.5), half = across / 2 - 0.025;
    add_box(louvres, along ? glm::dvec3(at - 0.002, 0.002, -half) : glm::dvec3(-half, 0.002, at - 0.002),
            along ? glm::dvec3(at + 0.002, 0.042, half) : glm::dvec3(half, 0.042, at + 0.002));
  }
  return {body, lamp, louvres};
}

MeshParts downlight() {
  MeshPart body = part_of(white), lamp = part_of(light);
  add_turned(body, {0, -0.006, 0}, 1, {{0, 0.10}, {0.006, 0.105}, {0.007, 0.085}, {0.14, 0.085}}, 16);
  add_turned(lamp, {0, -0.009, 0}, 1, {{0, 0.07}, {0.003, 0.075}}, 16);
  return {body, lamp};
}

MeshParts emergency_light() {
  MeshPart body = part_of(white), sign = part_of({0.02, 0.40, 0.14});
  add_box(body, {-0.17, -0.05, -0.03}, {0.17, 0, 0.03});
  add_box(sign, {-0.16, -0.25, -0.005}, {0.16, -0.05, 0.005});
  return {body, sign};
}

MeshParts square_diffuser(double size) {
  MeshPart body = part_of(white), box = part_of(galvanised);
  add_flat_frame(body, -0.005, 0.01, {size, size}, {size - 0.05, size - 0.05});
  for (int i = 1; i < 4; ++i) {
    const double s = size * (1 - 0.25 * i);
    add_flat_frame(body, -0.004 - 0.006 * i, 0.03, {s + 0.02, s + 0.02}, {s - 0.02, s - 0.02});
  }
  add_box(box, {-size * 0.46, 0.04, -size * 0.46}, {size * 0.46, 0.24, size * 0.46});
  add_turned(box, {0, 0.24, 0}, 1, {{0, 0.085}, {0.07, 0.085}}, 16);
  return {body, box};
}

MeshParts ceiling_grille(double width, double depth, double box) {
  MeshPart body = part_of(white), duct = part_of(galvanised);
  add_flat_frame(body, -0.008, 0.02, {width, depth}, {width - 0.05, depth - 0.05});
  const int count = std::clamp(static_cast<int>(depth / 0.03), 4, 16);
  for (int i = 0; i < count; ++i) {
    const double z = (depth - 0.05) * ((i + 0.5) / count - 0.5);
    add_box(body, {-width / 2 + 0.025, -0.004, z - 0.002}, {width / 2 - 0.025, 0.016, z + 0.006});
  }
  add_flat_frame(duct, 0.02, box, {width - 0.02, depth - 0.02}, {width - 0.04, depth - 0.04});
  return {body, duct};
}

MeshParts sprinkler() {
  MeshPart body = part_of(brass), rose = part_of(white), bulb = part_of(red);
  add_turned(rose, {0, -0.006, 0}, 1, {{0, 0.038}, {0.006, 0.042}}, 12);
  add_turned(body, {0, -0.03, 0}, 1, {{0, 0.014}, {0.02, 0.014}, {0.06, 0.013}}, 8);
  for (const double x : {-1.0, 1.0}) {
    add_rod(body, {0.012 * x, -0.03, 0}, {0.016 * x, -0.045, 0}, 0.003, 5);
    add_rod(body, {0.016 * x, -0.045, 0}, {0, -0.065, 0}, 0.003, 5);
  }
  add_turned(body, {0, -0.068, 0}, 1, {{0, 0.018}, {0.003, 0.018}}, 12);
  add_rod(bulb, {0, -0.03, 0}, {0, -0.062, 0}, 0.0035, 6);
  return {body, rose, bulb};
}

MeshParts smoke_detector() {
  MeshPart body = part_of(white), led = part_of(red);
  add_turned(body, {0, -0.05, 0}, 1, {{0, 0.02}, {0.008, 0.035}, {0.02, 0.035}, {0.022, 0.05}, {0.05, 0.052}},
             16);
  add_box(led, {0.036, -0.032, -0.004}, {0.042, -0.026, 0.004});
  return {body, led};
}

MeshParts loudspeaker() {
  MeshPart body = part_of(white), box = part_of(dark);
  add_turned(body, {0, -0.006, 0}, 1, {{0, 0.09}, {0.006, 0.1}}, 16);
  for (int i = 1; i < 4; ++i) add_torus(body, {0, -0.006, 0}, 1, 0.022 * i, 0.003, 10, 4);
  add_turned(box, {0, 0, 0}, 1, {{0, 0.085}, {0.08, 0.06}}, 12);
  return {body, box};
}

MeshParts cable_tray(double width, double length, int cables) {
  MeshPart tray = part_of(galvanised), runs = part_of(cable);
  for (const double side : {-1.0, 1.0}) {
    const double z = side * width / 2;
    add_box(tray, {0, 0, z - 0.002}, {length, 0.06, z + 0.002});
    add_box(tray, {0, 0.058, std::min(z, z - side * 0.015)}, {length, 0.06, std::max(z, z - side * 0.015)});
  }
  const int rungs = std::max(1, static_cast<int>(length / 0.3));
  for (int i = 0; i < rungs; ++i) {
    const double x = length * (i + 0.5) / rungs;
    add_box(tray, {x - 0.015, 0.004, -width / 2 + 0.002}, {x + 0.015, 0.016, width / 2 - 0.002});
  }
  for (int i = 0; i < cables; ++i) {
    const double radius = 0.008 + 0.003 * (i % 3), z = (width - 0.06) * ((i + 0.5) / cables - 0.5);
    add_rod(runs, {0, 0.016 + radius, z}, {length, 0.016 + radius, z}, radius, 8);
  }
  return {tray, runs};
}

double cable_tray_bend_radius(double width) { return width / 2 + 0.2; }

MeshParts cable_tray_bend(double width) {
  MeshPart tray = part_of(galvanised);
  const double radius = cable_tray_bend_radius(width);
  auto frames = bend_frames(radius, 5);
  // Travels in the plane of x and y; the sides stand along -z, which is up where it is placed.
  for (const double side : {-1.0, 1.0}) {
    auto edge = frames;
    for (SweepFrame& frame : edge) frame.centre += side * width / 2 * frame.u + glm::dvec3(0, 0, -0.03);
    add_solid(tray, edge, rectangle_profile(0.004, 0.06));
  }
  for (size_t i = 0; i + 1 < frames.size(); ++i) {
    const glm::dvec3 middle = 0.5 * (frames[i].centre + frames[i + 1].centre) + glm::dvec3(0, 0, -0.01);
    const glm::dvec3 out = glm::normalize(frames[i].u + frames[i + 1].u) * (width / 2 - 0.003);
    add_rod(tray, middle - out, middle + out, 0.01, 5);
  }
  return {tray};
}

MeshParts junction_box() {
  MeshPart body = part_of(galvanised);
  add_box(body, {-0.06, -0.03, -0.06}, {0.06, 0.03, 0.06});
  add_box(body, {-0.055, -0.034, -0.055}, {0.055, -0.03, 0.055});
  for (const double x : {-0.06, 0.06}) add_rod(body, {x, 0, 0}, {x * 1.35, 0, 0}, 0.018, 6);
  return {body};
}

MeshParts double_socket() {
  MeshPart body = part_of(white), holes = part_of(dark);
  add_box(body, {-0.08, -0.04, 0}, {0.08, 0.04, 0.012});
  for (const double x : {-0.04, 0.04}) {
    add_torus(body, {x, 0, 0.012}, 2, 0.022, 0.003, 8, 4);
    for (const double side : {-0.01, 0.01})
      add_rod(holes, {x + side, 0, 0.011}, {x + side, 0, 0.014}, 0.003, 5);
  }
  return {body, holes};
}

MeshParts light_switch() {
  MeshPart body = part_of(white);
  add_box(body, {-0.04, -0.04, 0}, {0.04, 0.04, 0.01});
  add_box(body, {-0.03, -0.03, 0.01}, {0.03, 0.03, 0.016});
  return {body};
}

MeshParts thermostat() {
  MeshPart body = part_of(white), knob = part_of(steel);
  add_box(body, {-0.04, -0.05, 0}, {0.04, 0.05, 0.025});
  add_turned(knob, {0, 0, 0.025}, 2, {{0, 0.025}, {0.012, 0.02}}, 12);
  return {body, knob};
}

MeshParts fire_extinguisher() {
  MeshPart body = part_of(red), head = part_of(dark);
  add_turned(body, {0, 0, 0.11}, 1, {{0, 0.07}, {0.03, 0.08}, {0.42, 0.08}, {0.48, 0.04}, {0.5, 0.03}}, 12);
  add_box(head, {-0.03, 0.5, 0.09}, {0.03, 0.55, 0.13});
  add_rod(head, {0, 0.54, 0.1}, {0.12, 0.56, 0.1}, 0.012, 6);
  add_rod(head, {0.05, 0.5, 0.12}, {0.1, 0.1, 0.12}, 0.012, 6);
  add_box(head, {-0.05, 0.2, 0}, {0.05, 0.3, 0.03});
  return {body, head};
}

MeshParts distribution_board(double width, double height) {
  MeshPart body = part_of({0.62, 0.63, 0.60}), trim = part_of(dark);
  add_box(body, {-width / 2, 0, 0}, {width / 2, height, 0.2});
  add_box(body, {-width / 2 + 0.02, 0.02, 0.2}, {width / 2 - 0.02, height - 0.02, 0.215});
  add_box(trim, {width / 2 - 0.08, height / 2 - 0.08, 0.215}, {width / 2 - 0.05, height / 2 + 0.08, 0.235});
  for (int i = 0; i < 6; ++i)
    add_box(trim, {-width / 4, height * 0.75 + 0.02 * i, 0.215},
            {width / 4, height * 0.75 + 0.01 + 0.02 * i, 0.22});
  return {body, trim};
}

MeshParts supply_rail(double length) {
  MeshPart body = part_of(white), ports = part_of(steel), lamp = part_of(light);
  add_box(body, {-length / 2, 0, 0}, {length / 2, 0.22, 0.08});
  add_box(lamp, {-length / 2 + 0.1, 0.22, 0.01}, {length / 2 - 0.1, 0.25, 0.07});
  const int count = std::clamp(static_cast<int>(length / 0.28), 4, 8);
  for (int i = 0; i < count; ++i) {
    const double x = length * ((i + 0.5) / count - 0.5);
    add_turned(ports, {x, 0.11, 0.08}, 2, {{0, 0.03}, {0.02, 0.025}}, 8);
  }
  return {body, ports, lamp};
}

MeshParts radiator(double length, double height) {
  MeshPart body = part_of(white), valve = part_of(steel);
  constexpr double gap = 0.04;
  for (const double z : {gap, gap + 0.07})
    add_box(body, {-length / 2, 0, z}, {length / 2, height, z + 0.015});
  add_box(body, {-length / 2, height, gap - 0.005}, {length / 2, height + 0.01, gap + 0.09});
  const int fins = std::clamp(static_cast<int>(length / 0.08), 6, 24);
  for (int i = 0; i < fins; ++i) {
    const double x = length * ((i + 0.5) / fins - 0.5);
    add_box(body, {x - 0.002, 0.03, gap + 0.015}, {x + 0.002, height - 0.03, gap + 0.07});
  }
  add_turned(valve, {length / 2, 0.06, gap + 0.045}, 0,
             {{0, 0.012}, {0.04, 0.012}, {0.045, 0.025}, {0.11, 0.022}}, 10);
  for (const double x : {-length / 3, length / 3})
    add_box(valve, {x - 0.015, 0.1, 0}, {x + 0.015, height - 0.1, gap});
  return {body, valve};
}

MeshParts fan_coil(double length) {
  MeshPart body = part_of(galvanised), parts = part_of(steel), motor = part_of(dark);
  add_box(body, {-length / 2, 0, -0.3}, {length / 2, 0.26, 0.3});
  add_flat_frame(parts, -0.06, 0, {length - 0.1, 0.3}, {length - 0.14, 0.26});
  for (const double x : {-length / 4, length / 4})
    add_turned(motor, {x, 0.13, 0.3}, 2, {{0, 0.1}, {0.06, 0.09}}, 12);
  for (int i = 0; i < 4; ++i)
    add_rod(parts, {(i % 2 ? 0.5 : -0.5) * length, 0.2, i / 2 ? 0.25 : -0.25},
            {(i % 2 ? 0.5 : -0.5) * length, 0.85, i / 2 ? 0.25 : -0.25}, 0.006, 6);
  return {body, parts, motor};
}

}  // namespace triptych
