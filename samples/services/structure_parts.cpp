#include "samples/services/structure_parts.hpp"

#include "samples/services/hospital_plan.hpp"
#include "samples/services/part_tools.hpp"
#include "samples/solids.hpp"

#include <algorithm>

namespace triptych {
namespace {

using namespace hospital;

const glm::dvec3 plaster(0.76, 0.75, 0.71), bricks(0.60, 0.56, 0.50), skirting_colour(0.20, 0.22, 0.24),
    concrete(0.42, 0.42, 0.41), frame_colour(0.50, 0.52, 0.54), steel(0.42, 0.44, 0.46),
    white(0.80, 0.80, 0.78);

}  // namespace

MeshParts wall(double length, double height, double thickness, const std::vector<Rect>& holes, bool facade) {
  constexpr double tall = 0.1, thick = 0.012;
  const double half = thickness / 2;
  const MeshPart body =
      pierced_box({0, 0, -half}, {length, height, half}, 2, holes, facade ? bricks : plaster);
  if (facade) return {body};
  MeshPart skirting = part_of(skirting_colour);
  std::vector<double> stops{0};
  std::vector<Rect> doors;
  for (const Rect& hole : holes)
    if (hole.z0 <= 0) doors.push_back(hole);
  std::sort(doors.begin(), doors.end(), [](const Rect& a, const Rect& b) { return a.x0 < b.x0; });
  for (const Rect& door : doors) stops.insert(stops.end(), {door.x0, door.x1});
  stops.push_back(length);
  for (size_t i = 0; i + 1 < stops.size(); i += 2) {
    if (stops[i + 1] - stops[i] < 0.05) continue;
    for (const double z : {-half - thick, half})
      add_box(skirting, {stops[i], 0, z}, {stops[i + 1], tall, z + thick});
  }
  return {body, skirting};
}

MeshParts floor_slab(double length, double deep, const glm::dvec3& covering) {
  MeshPart body = part_of(concrete), floor = part_of(covering);
  add_box(body, {0, -slab, 0}, {length, -0.01, deep});
  add_box(floor, {0, -0.01, 0}, {length, 0, deep});
  return {body, floor};
}

MeshParts suspended_ceiling(double length, double deep) {
  MeshPart panels = part_of(white), grid = part_of(steel);
  add_box(panels, {0, ceiling, 0}, {length, ceiling + 0.018, deep});
  constexpr double module = 0.6, bar = 0.012;
  for (double x = module; x < length - 0.1; x += module)
    add_box(grid, {x - bar, ceiling - 0.004, 0}, {x + bar, ceiling, deep});
  for (double z = 2 * module; z < deep - 0.1; z += 2 * module)
    add_box(grid, {0, ceiling - 0.003, z - bar}, {length, ceiling + 0.03, z + bar});
  return {panels, grid};
}

MeshParts door_frame() {
  constexpr double half = door_width / 2, deep = partition / 2 + 0.015;
  const MeshPart frame =
      pierced_box({-half, 0, -deep}, {half, door_height, deep}, 2,
                  {{-half + door_jamb, 0, half - door_jamb, door_height - door_jamb}}, frame_colour);
  MeshPart seals = part_of({0.08, 0.08, 0.09});
  const double in = half - door_jamb;
  for (const double x : {-in, in - 0.012})
    add_box(seals, {x, 0, 0.0}, {x + 0.012, door_height - door_jamb, 0.02});
  return {frame, seals};
}

MeshParts door_leaf(int variant) {
  constexpr double tints[3][3] = {{0.40, 0.26, 0.13}, {0.30, 0.42, 0.46}, {0.62, 0.60, 0.55}};
  const auto& tint = tints[variant % 3];
  constexpr double length = door_width - 2 * door_jamb, top = door_height - door_jamb - 0.005;
  MeshPart trim = part_of(steel);
  const std::vector<Rect> glass{{length - 0.42, 1.15, length - 0.22, 1.85}};
  // Along x first, where its hole is easily told; then turned so that it runs along z.
  MeshPart leaf = pierced_box({0, 0.01, -0.022}, {length, top, 0.022}, 2,
                              variant ? glass : std::vector<Rect>(), {tint[0], tint[1], tint[2]});
  for (glm::vec3& position : leaf.positions) position = {-position.z, position.y, position.x};
  for (const double x : {-0.022, 0.022}) {
    const double out = x < 0 ? -1 : 1;
    add_box(trim, {std::min(x, x + 0.003 * out), 0.05, 0.05},
            {std::max(x, x + 0.003 * out), 0.3, length - 0.05});
    add_rod(trim, {x, 1.05, length - 0.09}, {x + 0.06 * out, 1.05, length - 0.09}, 0.011);
    add_rod(trim, {x + 0.06 * out, 1.05, length - 0.08}, {x + 0.06 * out, 1.05, length - 0.2}, 0.01);
  }
  for (const double y : {0.25, 1.1, 1.9}) add_rod(trim, {-0.03, y, 0}, {-0.03, y + 0.1, 0}, 0.01, 6);
  return {leaf, trim};
}

MeshParts window_frame() {
  constexpr double half = window_width / 2, bar = 0.05;
  MeshPart frame = pierced_box({-half, window_sill, -0.05}, {half, window_top, 0.05}, 2,
                               {{-half + bar, window_sill + bar, -bar / 2, window_top - bar},
                                {bar / 2, window_sill + bar, half - bar, window_top - 0.45 - bar},
                                {bar / 2, window_top - 0.45, half - bar, window_top - bar}},
                               frame_colour);
  MeshPart sills = part_of(white);
  add_box(sills, {-half, window_sill - 0.01, -facade / 2 - 0.06}, {half, window_sill + 0.02, -0.05});
  add_box(sills, {-half, window_sill - 0.01, 0.05}, {half, window_sill + 0.02, facade / 2 + 0.06});
  add_rod(sills, {0, 1.5, 0.05}, {0, 1.5, 0.09}, 0.012, 6);
  return {frame, sills};
}

MeshParts stair(double width, double deep) {
  MeshPart steps = part_of(concrete), rails = part_of(steel);
  constexpr int count = 13;
  const double rise = storey / (2 * count), run = (deep - 2.6) / count, flight = width / 2 - 0.1;
  for (int i = 0; i < count; ++i) {
    const double z = 1.3 + run * i, y = rise * (i + 1), back = deep - 1.3 - run * i,
                 high = storey / 2 + rise * (i + 1);
    add_box(steps, {0, y - 0.18, z}, {flight, y, z + run});
    add_box(steps, {width - flight, high - 0.18, back - run}, {width, high, back});
  }
  add_box(steps, {0, storey / 2 - 0.2, deep - 1.3}, {width, storey / 2, deep});
  add_box(steps, {0, storey - 0.2, 0}, {width, storey, 1.3});
  add_rod(rails, {flight, 0.9, 1.3}, {flight, storey / 2 + 0.9, deep - 1.3}, 0.02);
  add_rod(rails, {width - flight, storey / 2 + 0.9, deep - 1.3}, {width - flight, storey + 0.9, 1.3}, 0.02);
  return {steps, rails};
}

}  // namespace triptych
