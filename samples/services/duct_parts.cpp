#include "samples/services/duct_parts.hpp"

#include "samples/services/part_tools.hpp"
#include "samples/sweep.hpp"

#include <algorithm>

namespace triptych {
namespace {

constexpr double sheet = 0.008, flange_height = 0.03, flange_depth = 0.02;
constexpr size_t round_sides = 16;
const glm::dvec3 steel(0.42, 0.44, 0.46), wool(0.62, 0.60, 0.52), dark(0.10, 0.10, 0.11),
    actuator(0.75, 0.35, 0.05);

/// A frame around a duct, with a bolt in each corner.
void add_flange(MeshPart& part, double from, double width, double height) {
  add_frame(part, from, from + flange_depth, {height + 2 * flange_height, width + 2 * flange_height},
            {height - 2 * sheet, width - 2 * sheet});
}

/// Profiles run along u = y, then v = z: the height comes first.
Profile outer_profile(double width, double height) { return rectangle_profile(height, width); }
Profile inner_profile(double width, double height) {
  return rectangle_profile(height - 2 * sheet, width - 2 * sheet);
}

}  // namespace

MeshParts rectangular_duct(const glm::dvec3& colour, double width, double height, double length) {
  MeshPart body = part_of(colour), flanges = part_of(steel);
  add_hollow(body, straight_frames(length), outer_profile(width, height), inner_profile(width, height));
  add_flange(flanges, 0, width, height);
  add_flange(flanges, length - flange_depth, width, height);
  for (const double y : {-1.0, 1.0})
    for (const double z : {-1.0, 1.0})
      add_rod(flanges, {-0.015, y * (height / 2 + 0.015), z * (width / 2 + 0.015)},
              {0.035, y * (height / 2 + 0.015), z * (width / 2 + 0.015)}, 0.008, 6);
  return {body, flanges};
}

double rectangular_bend_radius(double width) { return width / 2 + 0.15; }

MeshParts rectangular_bend(const glm::dvec3& colour, double width, double height) {
  MeshPart body = part_of(colour), flanges = part_of(steel);
  const double radius = rectangular_bend_radius(width);
  const auto frames = bend_frames(radius, 6);
  // A bend's u points at the corner's outside: there the width comes first.
  add_hollow(body, frames, rectangle_profile(width, height),
             rectangle_profile(width - 2 * sheet, height - 2 * sheet));
  add_frame(flanges, -radius, -radius + flange_depth, {width + 2 * flange_height, height + 2 * flange_height},
            {width - 2 * sheet, height - 2 * sheet});
  const double y = radius, half = width / 2 + flange_height, up = height / 2 + flange_height;
  for (const double side : {-1.0, 1.0}) {
    add_box(flanges, {-half, y - flange_depth, side > 0 ? up - flange_height : -up},
            {half, y, side > 0 ? up : -up + flange_height});
    add_box(flanges, {side > 0 ? half - flange_height : -half, y - flange_depth, -up + flange_height},
            {side > 0 ? half : -half + flange_height, y, up - flange_height});
  }
  return {body, flanges};
}

MeshParts rectangular_reducer(const glm::dvec3& colour, double width, double height, double to_width,
                              double length) {
  MeshPart body = part_of(colour), flanges = part_of(steel);
  const auto ends = straight_frames(length);
  add_looped(body, {placed_outline(ends[0], outer_profile(width, height)),
                    placed_outline(ends[1], outer_profile(to_width, height)),
                    placed_outline(ends[1], inner_profile(to_width, height)),
                    placed_outline(ends[0], inner_profile(width, height))});
  add_flange(flanges, 0, width, height);
  add_flange(flanges, length - flange_depth, to_width, height);
  return {body, flanges};
}

MeshParts duct_end_cap(const glm::dvec3& colour, double width, double height) {
  MeshPart body = part_of(colour), handle = part_of(steel);
  add_box(body, {0, -height / 2, -width / 2}, {0.02, height / 2, width / 2});
  add_flange(handle, -flange_depth, width, height);
  add_rod(handle, {0.05, 0, -0.08}, {0.05, 0, 0.08}, 0.008);
  return {body, handle};
}

MeshParts duct_take_off(const glm::dvec3& colour, double width, double height) {
  MeshPart body = part_of(colour), rims = part_of(steel);
  const double half = width / 2 + 0.03;
  add_box(body, {-half, -height, -half}, {half, 0, half});
  add_box(rims, {-half - 0.03, -0.02, -half - 0.03}, {half + 0.03, 0.0, half + 0.03});
  add_box(rims, {half, -height + 0.02, -half}, {half + 0.02, -0.04, half});
  return {body, rims};
}

MeshParts duct_insulation(double width, double height, double length) {
  constexpr double thickness = 0.035;
  MeshPart body = part_of(wool), bands = part_of(steel);
  add_frame(body, 0.03, length - 0.03, {height + 2 * thickness, width + 2 * thickness},
            {height + 0.004, width + 0.004});
  for (const double share : {0.25, 0.75})
    add_frame(bands, share * length - 0.01, share * length + 0.01,
              {height + 2 * thickness + 0.006, width + 2 * thickness + 0.006},
              {height + 2 * thickness - 0.002, width + 2 * thickness - 0.002});
  return {body, bands};
}

MeshParts duct_hanger(double width, double rods) {
  MeshPart part = part_of(steel);
  const double half = width / 2 + 0.045;
  add_box(part, {-0.02, -0.04, -half - 0.02}, {0.02, 0, half + 0.02});
  for (const double z : {-half, half}) {
    add_hanger_rod(part, {0, -0.06, z}, rods + 0.06);
    add_box(part, {-0.03, rods - 0.008, z - 0.03}, {0.03, rods, z + 0.03});
  }
  return {part};
}

MeshParts round_duct(const glm::dvec3& colour, double diameter, double length) {
  MeshPart body = part_of(colour);
  add_tube(body, 0, length, diameter / 2, diameter / 2 - sheet, round_sides);
  return {body};
}

double round_bend_radius(double diameter) { return diameter; }

MeshParts round_bend(const glm::dvec3& colour, double diameter) {
  MeshPart body = part_of(colour);
  add_hollow(body, bend_frames(round_bend_radius(diameter), 5), circle_profile(diameter / 2, round_sides),
             circle_profile(diameter / 2 - sheet, round_sides));
  return {body};
}

MeshParts round_coupling(const glm::dvec3& colour, double diameter) {
  MeshPart body = part_of(colour);
  add_tube(body, -0.04, 0.04, diameter / 2 + 0.006, diameter / 2 - 0.002, round_sides);
  return {body};
}

MeshParts round_tee(const glm::dvec3& colour, double diameter, double branch) {
  MeshPart body = part_of(colour);
  add_tube(body, 0, 0.4, diameter / 2, diameter / 2 - sheet, round_sides);
  add_turned(body, {0.2, 0, diameter / 2 - 0.02}, 2,
             {{0, branch / 2 + 0.03}, {0.05, branch / 2}, {0.12, branch / 2}}, round_sides);
  return {body};
}

MeshParts round_end_cap(const glm::dvec3& colour, double diameter) {
  MeshPart body = part_of(colour);
  add_turned(body, {-0.03, 0, 0}, 0, {{0, diameter / 2 + 0.004}, {0.05, diameter / 2 + 0.004}}, round_sides);
  return {body};
}

MeshParts duct_strap(double diameter, double rod) {
  MeshPart part = part_of(steel);
  add_tube(part, -0.015, 0.015, diameter / 2 + 0.004, diameter / 2 + 0.001, 12);
  add_hanger_rod(part, {0, diameter / 2, 0}, rod - diameter / 2);
  return {part};
}

MeshParts flexible_duct(double diameter, double length) {
  MeshPart body = part_of({0.55, 0.56, 0.58});
  const auto waves = static_cast<size_t>(std::clamp(length / 0.06, 4.0, 9.0));
  std::vector<glm::dvec2> profile;
  for (size_t i = 0; i <= 2 * waves; ++i)
    profile.emplace_back(length * static_cast<double>(i) / static_cast<double>(2 * waves),
                         diameter / 2 - (i % 2 ? 0.0 : 0.008));
  add_turned(body, {0, 0, 0}, 0, profile, 12);
  return {body};
}

MeshParts volume_box(const glm::dvec3& colour, double width, double height, double diameter) {
  MeshPart body = part_of(colour), collars = part_of(steel), control = part_of(actuator);
  const double half = width / 2 + 0.08, up = height / 2 + 0.06;
  add_box(body, {0.06, -up, -half}, {0.78, up, half});
  add_frame(collars, 0, 0.08, {height, width}, {height - 2 * sheet, width - 2 * sheet});
  add_flange(collars, 0, width, height);
  add_tube(collars, 0.76, 0.9, diameter / 2, diameter / 2 - sheet, round_sides);
  add_box(control, {0.25, -0.08, half}, {0.5, 0.1, half + 0.09});
  add_rod(control, {0.375, 0, half + 0.09}, {0.375, 0, half + 0.12}, 0.02);
  return {body, collars, control};
}

MeshParts fire_damper(const glm::dvec3& colour, double width, double height) {
  MeshPart body = part_of(colour), blades = part_of(dark), control = part_of({0.6, 0.05, 0.04});
  add_frame(body, 0, 0.3, {height + 0.02, width + 0.02}, {height - 2 * sheet, width - 2 * sheet});
  add_flange(body, 0, width, height);
  add_flange(body, 0.28, width, height);
  constexpr int count = 4;
  for (int i = 0; i < count; ++i) {
    const double y = height * ((i + 0.5) / count - 0.5);
    add_box(blades, {0.1, y - 0.005, -width / 2 + 0.02}, {0.2, y + 0.005, width / 2 - 0.02});
  }
  add_box(control, {0.05, -0.09, width / 2 + 0.04}, {0.25, 0.09, width / 2 + 0.15});
  return {body, blades, control};
}

MeshParts silencer(const glm::dvec3& colour, double width, double height, double length) {
  MeshPart body = part_of(colour), splitters = part_of(dark);
  add_frame(body, 0, length, {height + 0.06, width + 0.06}, {height, width});
  add_flange(body, 0, width, height);
  add_flange(body, length - flange_depth, width, height);
  const int count = std::max(1, static_cast<int>(width / 0.2));
  for (int i = 0; i < count; ++i) {
    const double z = width * ((i + 0.5) / count - 0.5);
    add_box(splitters, {0.05, -height / 2, z - 0.05}, {length - 0.05, height / 2, z + 0.05});
  }
  return {body, splitters};
}

}  // namespace triptych
