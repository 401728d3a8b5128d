#include "samples/placing.hpp"
#include "samples/services/building_services.hpp"
#include "samples/services/duct_parts.hpp"
#include "samples/services/fixture_parts.hpp"
#include "samples/services/pipe_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {

namespace service_systems {
const DuctSystem supply_air{"supply air", {0.30, 0.46, 0.62}}, return_air{"return air", {0.62, 0.52, 0.28}};
const PipeSystem heating_flow{"heating flow", {0.60, 0.10, 0.06}, 0.054, true},
    heating_return{"heating return", {0.45, 0.14, 0.30}, 0.054, true},
    cooling_flow{"cooling flow", {0.05, 0.30, 0.60}, 0.108, false},
    cooling_return{"cooling return", {0.10, 0.42, 0.55}, 0.108, false},
    cold_water{"cold water", {0.10, 0.45, 0.25}, 0.042, false},
    hot_water{"hot water", {0.62, 0.28, 0.06}, 0.035, true},
    oxygen{"oxygen", {0.75, 0.76, 0.78}, 0.022, false}, vacuum{"vacuum", {0.65, 0.62, 0.10}, 0.035, false},
    medical_air{"medical air", {0.15, 0.15, 0.17}, 0.022, false},
    sprinklers{"sprinkler", {0.55, 0.06, 0.05}, 0.076, false}, drain{"drain", {0.28, 0.24, 0.22}, 0.1, false},
    conduit{"conduit", {0.50, 0.51, 0.53}, 0.025, false};

const std::vector<PipeSystem>& on_the_rack() {
  static const std::vector<PipeSystem> systems{heating_flow,   heating_return, cooling_flow,
                                               cooling_return, cold_water,     hot_water,
                                               oxygen,         vacuum,         medical_air};
  return systems;
}
}  // namespace service_systems

double main_duct_offset(const DuctSystem& system) {
  return system.name == service_systems::supply_air.name ? -0.6 : 0.6;
}

double rack_offset(size_t pipe) { return -1.02 + 0.145 * static_cast<double>(pipe); }

namespace {

using namespace hospital;
using namespace service_heights;
using namespace service_systems;

constexpr double end_gap = 0.5;  // to the outer wall

const glm::dvec3 east(1, 0, 0);

/// A block's main: wide at the shaft, narrower twice, closed at its end.
void add_main(const Placer& placer, const DuctSystem& system, double from, double to, double z) {
  constexpr double widths[] = {0.8, 0.6, 0.4}, reducer = 0.5;
  const double third = (to - from) / 3;
  const Hanging hanging{2.4};
  for (int i = 0; i < 3; ++i) {
    const double x0 = from + third * i + (i > 0 ? reducer : 0), x1 = from + third * (i + 1);
    lay_duct(placer, system, widths[i], main_height, {{x0, main_duct, z}, {x1, main_duct, z}}, hanging, true);
    if (i == 2) break;
    const double width = widths[i], next = widths[i + 1];
    placer.put(
        fmt::format("{} reducer {:.0f}-{:.0f}", system.name, width * 1000, next * 1000),
        [=] { return rectangular_reducer(system.colour, width, main_height, next, reducer); },
        laid({x1, main_duct, z}, east));
  }
  placer.put(
      fmt::format("{} end cap", system.name),
      [=] { return duct_end_cap(system.colour, widths[2], main_height); }, laid({to, main_duct, z}, east));
}

void add_racks(const Placer& placer, double z) {
  const auto& systems = on_the_rack();
  for (size_t i = 0; i < systems.size(); ++i) {
    const double at = z + rack_offset(i);
    lay_pipe(placer, systems[i], {{end_gap, rack, at}, {width - end_gap, rack, at}});
  }
  lay_tray(
      placer, "power tray", 0.3, 6,
      {{end_gap, rack - 0.05, z + tray_offsets[0]}, {width - end_gap, rack - 0.05, z + tray_offsets[0]}});
  lay_tray(
      placer, "data tray", 0.3, 9,
      {{end_gap, rack - 0.05, z + tray_offsets[1]}, {width - end_gap, rack - 0.05, z + tray_offsets[1]}});
  constexpr double below = rack - 0.06, length = corridor - partition - 0.02;
  for (double x = 1; x < width; x += 2)
    placer.put(
        "trapeze", [] { return trapeze(length, slab_underside - below); }, placed({x, below, z}, 0));
  for (size_t i = 0; i < systems.size(); ++i)
    for (double x = 9; x < width; x += 18) {
      const double d = systems[i].diameter;
      const glm::dvec3 at(x + 0.3 + 0.2 * static_cast<double>(i), rack, z + rack_offset(i));
      placer.put(
          fmt::format("valve d{:.0f}", d * 1000), [=] { return d < 0.05 ? ball_valve(d) : gate_valve(d); },
          laid(at, east));
    }
}

void add_ceiling_row(const Placer& placer, double z) {
  for (double x = 1.2; x < width - 0.6; x += 2.4)
    placer.put(
        "luminaire 1200x300", [] { return luminaire(1.2, 0.3); }, placed({x, ceiling, z}, 0));
  for (double x = 2.4; x < width; x += 4.8)
    placer.put(
        "smoke detector", [] { return smoke_detector(); }, placed({x, ceiling, z + 0.4}, 0));
  for (double x = 4.2; x < width; x += 7.2) {
    placer.put(
        "loudspeaker", [] { return loudspeaker(); }, placed({x, ceiling, z - 0.4}, 0));
    placer.put(
        "emergency light", [] { return emergency_light(); },
        placed({x + 1.8, ceiling, z}, glm::half_pi<double>()));
  }
  // Sprinklers below their main.
  lay_pipe(placer, sprinklers, {{end_gap, sprinkler_main, z}, {width - end_gap, sprinkler_main, z}},
           Hanging{2.6});
  PipeSystem drop = sprinklers;
  drop.diameter = 0.028;
  for (double x = 1.5; x < width; x += 3) {
    placer.put(
        "sprinkler tee", [] { return pipe_tee(sprinklers.colour, sprinklers.diameter, 0.028); },
        placed_along({x, sprinkler_main, z}, east, {0, -1, 0}));
    lay_pipe(placer, drop, {{x, sprinkler_main - 0.05, z}, {x, ceiling + 0.02, z}});
    placer.put(
        "sprinkler head", [] { return sprinkler(); }, placed({x, ceiling, z}, 0));
  }
}

}  // namespace

void add_corridor_services(ObjectScene& scene, int storey, int number) {
  const double z = corridor_z[number];
  const Placer placer{scene, storey, fmt::format("{}.corridor {}", storey, number + 1)};
  for (const auto& [from, to] : blocks)
    for (const DuctSystem* system : {&supply_air, &return_air})
      add_main(placer, *system, from + end_gap, to - end_gap, z + main_duct_offset(*system));
  add_racks(placer, z);
  add_ceiling_row(placer, z);
}

void add_shaft_services(ObjectScene& scene, const HospitalRoom& shaft) {
  const Placer placer{scene, shaft.storey, shaft.name + " shaft"};
  const Rect area = shaft.area();
  const double x = area.x0 + 0.7;
  size_t number = 0;
  for (const DuctSystem* system : {&supply_air, &return_air}) {
    // The riser in pieces of a storey's third, each turned upright; a connection to the main.
    const double t = 1.0 + 2.2 * static_cast<double>(number++),
                 main_t = (corridor_z[shaft.corridor] + main_duct_offset(*system) - shaft.corridor_wall) *
                          shaft.inward;
    const double piece = storey / 3;
    for (int i = 0; i < 3; ++i)
      placer.put(
          fmt::format("{} riser", system->name),
          [=] { return rectangular_duct(system->colour, 1.2, 0.8, piece); },
          placed_along(shaft.at(x, -slab + piece * i, t), {0, 1, 0}, {1, 0, 0}));
    const double cross = x + (number == 1 ? 0.0 : 0.9);
    lay_duct(placer, *system, 0.5, 0.3,
             {shaft.at(cross, main_duct, t - 0.6), shaft.at(cross, main_duct, main_t)});
    placer.put(
        fmt::format("{} fire damper 500x300", system->name),
        [=] { return fire_damper(system->colour, 0.5, 0.3); },
        laid(shaft.at(cross, main_duct, 0.15), shaft.into()));
  }
  const auto& systems = on_the_rack();
  for (size_t i = 0; i < systems.size(); ++i) {
    const double at = area.x0 + 0.3 + 0.22 * static_cast<double>(i), t = area.depth() - 0.9;
    PipeSystem riser = systems[i];
    riser.piece = storey / 2;
    lay_pipe(placer, riser, {shaft.at(at, -slab, t), shaft.at(at, storey - slab, t)});
    const double d = riser.diameter;
    for (const double y : {0.6, 2.1, 3.6})
      placer.put(
          fmt::format("bracket d{:.0f}", d * 1000), [=] { return pipe_bracket(d); },
          placed_along(shaft.at(at, y, t), {0, 1, 0}, -shaft.into()));
    // From the riser to the corridor's rack, each at a height of its own.
    const double level = rack + 0.12 + 0.05 * static_cast<double>(i);
    const double rack_t = (corridor_z[shaft.corridor] + rack_offset(i) - shaft.corridor_wall) * shaft.inward;
    lay_pipe(placer, systems[i],
             {shaft.at(at + 0.02, level, t - 0.1), shaft.at(at + 0.02, level, rack_t),
              shaft.at(at + 0.02, rack, rack_t)});
    placer.put(
        fmt::format("valve d{:.0f}", d * 1000), [=] { return d < 0.05 ? ball_valve(d) : gate_valve(d); },
        laid(shaft.at(at + 0.02, level, 0.8 + 0.3 * static_cast<double>(i % 3)), shaft.into()));
  }
  PipeSystem stack = drain;
  stack.piece = storey / 2;
  lay_pipe(placer, stack, {shaft.at(area.x1 - 0.3, -slab, 5.2), shaft.at(area.x1 - 0.3, storey - slab, 5.2)});
  for (const double t : {4.2, 4.7})
    placer.put(
        "riser tray", [] { return cable_tray(0.3, storey, 6); },
        placed_along(shaft.at(area.x1 - 0.1, -slab, t), {0, 1, 0}, {-1, 0, 0}));
  for (int i = 0; i < 3; ++i) {
    const double height = 0.8 + 0.2 * i;
    placer.put(
        fmt::format("distribution board {}", i + 1), [=] { return distribution_board(0.5, height); },
        placed(shaft.at(area.x0 + 0.4 + 0.7 * i, 0.6, shaft.depth() - 0.02),
               shaft.inward > 0 ? glm::pi<double>() : 0));
  }
}

}  // namespace triptych
