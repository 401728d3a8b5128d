#include "samples/placing.hpp"
#include "samples/services/building_services.hpp"
#include "samples/services/duct_parts.hpp"
#include "samples/services/fixture_parts.hpp"
#include "samples/services/pipe_parts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>

namespace triptych {
namespace {

using namespace hospital;
using namespace service_heights;
using namespace service_systems;

constexpr double quarter = glm::half_pi<double>();
const glm::dvec3 east(1, 0, 0), up(0, 1, 0);

PipeSystem thinner(PipeSystem system, double diameter) {
  system.diameter = diameter;
  return system;
}

class RoomServices {
 public:
  RoomServices(ObjectScene& scene, const HospitalRoom& room, const Random& random)
      : room_(room),
        area_(room.area()),
        random_(random),
        placer_{scene, room.storey, room.name + " " + room_use_name(room.use)} {}

  void add() {
    add_supply();
    add_return();
    add_sprinklers();
    add_lights();
    room_.outer ? add_radiators() : add_fan_coil();
    if (room_.use != RoomUse::store && room_.use != RoomUse::lounge && room_.use != RoomUse::plant_room)
      add_water();
    if (room_.use == RoomUse::ward || room_.use == RoomUse::treatment) add_gases();
    add_on_walls();
  }

 private:
  /// From the corridor's wall, of what is so far from its corridor's middle.
  double offset_t(double offset) const {
    return (corridor_z[room_.corridor] + offset - room_.corridor_wall) * room_.inward;
  }
  /// Nobody builds two rooms alike: places differ by a few centimetres, and with them lengths.
  double about(double place, double by = 0.06) { return place + random_.between(-by, by); }
  double x_at(double share) const { return area_.x0 + share * area_.width(); }

  /// A boot below the main and a level duct into the room as far as t; returns where it ends.
  void add_branch(const DuctSystem& system, double x, double to, double wide) {
    const double from = offset_t(main_duct_offset(system));
    constexpr double under = main_duct - main_height / 2;
    const double tall = under - (branch - branch_height / 2) + 0.02;
    placer_.put(
        fmt::format("{} take-off {:.0f}", system.name, wide * 1000),
        [=] { return duct_take_off(system.colour, wide, tall); },
        placed_along(room_.at(x, under, from), room_.into(), up));
    lay_duct(placer_, system, wide, branch_height,
             {room_.at(x, branch, from + wide / 2 + 0.05), room_.at(x, branch, to)}, Hanging{1.5}, true);
    placer_.put(
        fmt::format("{} fire damper {:.0f}x220", system.name, wide * 1000),
        [=] { return fire_damper(system.colour, wide, branch_height); },
        laid(room_.at(x, branch, -0.15), room_.into()));
  }

  void add_supply() {
    constexpr double wide = 0.3, trunk = 0.25, twig = 0.17, box_length = 0.9;
    const double x = about(x_at(0.5) - 0.2), box_at = about(1.05, 0.05);
    add_branch(supply_air, x, box_at, wide);
    placer_.put(
        "volume box", [] { return volume_box(supply_air.colour, wide, branch_height, trunk); },
        laid(room_.at(x, branch, box_at), room_.into()));
    placer_.put(
        "silencer 300", [] { return silencer(supply_air.colour, 0.3, 0.22, 0.6); },
        laid(room_.at(x, branch, 0.35), room_.into()));
    const int rows = std::max(1, static_cast<int>(std::lround((room_.depth() - 2) / 2.4)));
    const int sides = area_.width() > 3.4 ? 2 : 1;
    double from = box_at + box_length;
    for (int row = 0; row < rows; ++row) {
      const double at = from + (room_.depth() - 0.9 - from) * (row == 0 ? 0.25 : 1.0 / (rows - row));
      const bool last = row + 1 == rows;
      lay_round_duct(placer_, supply_air, trunk, {room_.at(x, branch, from), room_.at(x, branch, at - 0.2)},
                     Hanging{1.6});
      for (int side = 0; side < sides; ++side) {
        const glm::dvec3 out = side == 0 ? east : -east;
        // Its branch leaves along z of the part, which is x × y.
        placer_.put(
            "supply tee", [] { return round_tee(supply_air.colour, trunk, twig); },
            side == 0
                ? placed_along(room_.at(x, branch, at - 0.2), room_.into(), room_.inward > 0 ? up : -up)
                : placed_along(room_.at(x, branch, at + 0.2), -room_.into(), room_.inward > 0 ? up : -up));
        add_diffuser(room_.at(x, branch, at), out, side == 0 ? area_.x1 - x : x - area_.x0, trunk, twig);
      }
      if (last)
        placer_.put(
            "supply end cap", [] { return round_end_cap(supply_air.colour, trunk); },
            laid(room_.at(x, branch, at + 0.2), room_.into()));
      from = at + 0.2;
    }
  }

  /// A twig from the trunk's tee to a diffuser in the ceiling: duct, bend, a flexible end.
  void add_diffuser(const glm::dvec3& tee, const glm::dvec3& out, double room_left, double trunk,
                    double twig) {
    const double reach = about(std::max(0.5, room_left * 0.55));
    const glm::dvec3 above = tee + out * reach, start = tee + out * (trunk / 2 + 0.1);
    constexpr double collar = ceiling + 0.31, flexible = 0.12;
    lay_round_duct(placer_, supply_air, twig, {start, above, {above.x, collar + flexible - 0.01, above.z}});
    placer_.put(
        "flexible duct", [] { return flexible_duct(0.17, flexible); },
        placed_along({above.x, collar, above.z}, up, east));
    placer_.put(
        "diffuser 600", [] { return square_diffuser(0.6); }, placed({above.x, ceiling, above.z}, 0));
  }

  void add_return() {
    constexpr double wide = 0.25;
    const double x = std::min(about(x_at(0.5) + 0.75), area_.x1 - 0.35),
                 end = about(std::min(room_.depth() - 0.9, 4.6));
    add_branch(return_air, x, end, wide);
    placer_.put(
        "return end cap 250", [] { return duct_end_cap(return_air.colour, wide, branch_height); },
        laid(room_.at(x, branch, end), room_.into()));
    for (double t = 1.6; t < end; t += 2.4)
      placer_.put(
          "return grille", [] { return ceiling_grille(0.4, 0.3, branch - branch_height / 2 - ceiling); },
          placed(room_.at(x, ceiling, t), 0));
  }

  void add_sprinklers() {
    constexpr double level = sprinkler_main - 0.02;
    const PipeSystem line = thinner(sprinklers, 0.035), drop = thinner(sprinklers, 0.028);
    const int lines = area_.width() > 4.6 ? 2 : 1;
    for (int i = 0; i < lines; ++i) {
      const double x = x_at((i + 0.5) / lines) + 0.42, end = about(room_.depth() - 0.8);
      lay_pipe(placer_, line, {room_.at(x, level, offset_t(0)), room_.at(x, level, end)}, Hanging{1.8});
      for (double t = 1.3; t < end; t += 2.6) {
        placer_.put(
            "sprinkler tee small", [=] { return pipe_tee(sprinklers.colour, 0.035, 0.028); },
            placed_along(room_.at(x, level, t), room_.into(), -up));
        lay_pipe(placer_, drop, {room_.at(x, level - 0.03, t), room_.at(x, ceiling + 0.02, t)});
        placer_.put(
            "sprinkler head", [] { return sprinkler(); }, placed(room_.at(x, ceiling, t), 0));
      }
    }
  }

  void add_lights() {
    const int columns = std::max(1, static_cast<int>(area_.width() / 2.2)),
              rows = std::max(1, static_cast<int>(room_.depth() / 2.4));
    const bool small = room_.use == RoomUse::lavatory || room_.use == RoomUse::store;
    const double tray = offset_t(tray_offsets[0]);
    const double spine = about(x_at(0.5) + 0.12, 0.03);
    const PipeSystem& pipe_system = conduit;
    lay_pipe(placer_, pipe_system,
             {room_.at(spine, rack + 0.06, tray), room_.at(spine, rack + 0.06, about(room_.depth() - 0.7))},
             Hanging{1.6});
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double x = x_at((column + 0.5) / columns), t = 0.2 + (room_.depth() - 0.4) * (row + 0.5) / rows;
        const glm::dvec3 at = room_.at(x, ceiling, t);
        if (small) {
          placer_.put(
              "downlight", [] { return downlight(); }, placed(at, 0));
        } else if (room_.use == RoomUse::office || room_.use == RoomUse::laboratory) {
          placer_.put(
              "luminaire 300x1200", [] { return luminaire(0.3, 1.2); }, placed(at, 0));
        } else {
          placer_.put(
              "luminaire 600x600", [] { return luminaire(0.6, 0.6); }, placed(at, 0));
        }
        const double side = x < spine ? -1 : 1, reach = std::abs(x - spine);
        if (reach < 0.2) continue;
        const glm::dvec3 box = room_.at(spine, rack + 0.06, t);
        placer_.put(
            "junction box", [] { return junction_box(); }, placed(box, 0));
        lay_pipe(placer_, pipe_system,
                 {box + glm::dvec3(side * 0.08, 0, 0), {x, box.y, box.z}, {x, ceiling + 0.15, box.z}},
                 Hanging{1.5});
      }
    placer_.put(
        "smoke detector", [] { return smoke_detector(); },
        placed(room_.at(x_at(0.5) + 0.3, ceiling, room_.depth() / 2), 0));
    if (random_.chance(0.5))
      placer_.put(
          "loudspeaker", [] { return loudspeaker(); },
          placed(room_.at(x_at(0.5) - 0.35, ceiling, room_.depth() / 2 + 0.4), 0));
  }

  /// A pair of pipes from the rack, over the ceiling, to a place: down there if `foot` says how far.
  void add_pair(const PipeSystem& flow, size_t flow_rack, const PipeSystem& back, size_t back_rack, double x,
                double to, double foot) {
    for (int i = 0; i < 2; ++i) {
      const PipeSystem& system = i == 0 ? flow : back;
      const double at = x + 0.09 * i, from = offset_t(rack_offset(i == 0 ? flow_rack : back_rack));
      lay_pipe(placer_, system,
               {room_.at(at, rack + 0.04, from), room_.at(at, room_pipes, from), room_.at(at, room_pipes, to),
                room_.at(at, foot, to)},
               Hanging{1.5});
      const double d = system.diameter;
      placer_.put(
          fmt::format("valve d{:.0f}", d * 1000), [=] { return ball_valve(d); },
          laid(room_.at(at, room_pipes, 0.3), room_.into()));
      placer_.put(
          fmt::format("bracket d{:.0f}", d * 1000), [=] { return pipe_bracket(d); },
          placed_along(room_.at(at, 1.8, to), up, -room_.into()));
    }
  }

  void add_radiators() {
    const double wall = room_.depth() - 0.09;
    const double x = area_.x0 + 0.25;
    add_pair(thinner(heating_flow, 0.022), 0, thinner(heating_return, 0.022), 1, x, wall, 0.2);
    const int windows = std::max(1, static_cast<int>(room_.grid.width() / 2.1));
    double from = x + 0.15;
    for (int i = 0; i < windows; ++i) {
      const double middle = room_.grid.x0 + room_.grid.width() * (i + 0.5) / windows, length = 1.0;
      placer_.put(
          "radiator 1000x600", [=] { return radiator(length, 0.6); },
          placed(room_.at(middle, 0.15, room_.depth() + 0.05), room_.inward > 0 ? 2 * quarter : 0));
      const double to = middle - length / 2 - 0.05;
      if (to > from + 0.1)
        for (const double y : {0.12, 0.2})
          lay_pipe(placer_, thinner(y < 0.15 ? heating_return : heating_flow, 0.015),
                   {room_.at(from, y, wall), room_.at(to, y, wall)});
      from = middle + length / 2 + 0.15;
    }
  }

  void add_fan_coil() {
    const double x = about(x_at(0.28)), t = about(room_.depth() - 1.6);
    add_pair(thinner(cooling_flow, 0.028), 2, thinner(cooling_return, 0.028), 3, x, t - 0.4,
             room_pipes - 0.12);
    placer_.put(
        "fan coil", [] { return fan_coil(1.0); }, placed(room_.at(x, slab_underside - 0.85, t), 0));
    placer_.put(
        "supply grille", [] { return ceiling_grille(0.9, 0.3, 0.5); }, placed(room_.at(x, ceiling, t), 0));
    placer_.put(
        "condensate pump", [] { return pump(0.08); }, placed(room_.at(x + 0.6, slab_underside - 0.85, t), 0));
  }

  /// Cold and hot to the basin beside the door, a drain down through the slab.
  void add_water() {
    const bool western = room_.door > x_at(0.5);  // away from the door
    const double side = western ? 1 : -1, x = (western ? area_.x0 : area_.x1) + side * 0.07, t = 1.1;
    for (int i = 0; i < 2; ++i) {
      const PipeSystem system = thinner(i == 0 ? cold_water : hot_water, 0.018);
      const double at = x + side * 0.06 * i, from = offset_t(rack_offset(i == 0 ? 4 : 5)),
                   end = t - 0.09 + 0.18 * i;
      lay_pipe(placer_, system,
               {room_.at(at, rack + 0.03, from), room_.at(at, room_pipes - 0.06, from),
                room_.at(at, room_pipes - 0.06, end), room_.at(at, 0.62, end)},
               Hanging{1.2});
      placer_.put(
          "valve d18", [] { return ball_valve(0.018); },
          placed_along(room_.at(at, 0.68, end), up, room_.into()));
      placer_.put(
          "bracket d18", [] { return pipe_bracket(0.018); },
          placed_along(room_.at(at, 1.6, end), up, {-side, 0, 0}));
    }
    if (room_.storey == 0) return;
    const PipeSystem waste = thinner(drain, 0.05);
    constexpr double below = -slab - 0.22;
    lay_pipe(placer_, waste, {room_.at(x, 0.6, t), room_.at(x, below, t), room_.at(x, below, 0.35)},
             Hanging{});
    placer_.put(
        "drain tee", [] { return pipe_tee(drain.colour, 0.05, 0.05); },
        placed_along(room_.at(x, below, 0.6), room_.into(), -up));
  }

  void add_gases() {
    const double x = area_.x0 + 0.05;
    const PipeSystem* systems[] = {&oxygen, &vacuum, &medical_air};
    for (size_t i = 0; i < 3; ++i) {
      const PipeSystem system = thinner(*systems[i], 0.015);
      const double from = offset_t(rack_offset(6 + i)),
                   level = room_pipes - 0.14 + 0.03 * static_cast<double>(i),
                   at = x + 0.03 * static_cast<double>(i),
                   end = about(room_.depth() * 0.45 + 0.12 * static_cast<double>(i), 0.02);
      lay_pipe(placer_, system,
               {room_.at(at, rack + 0.02, from), room_.at(at, level, from), room_.at(at, level, end),
                room_.at(at, 1.65, end)},
               Hanging{1.6});
      placer_.put(
          "valve d15", [] { return ball_valve(0.015); }, laid(room_.at(at, level, 0.5), room_.into()));
      placer_.put(
          "bracket d15", [] { return pipe_bracket(0.015); },
          placed_along(room_.at(at, 2.2, end), up, {-1, 0, 0}));
    }
    placer_.put(
        "supply rail 1800", [] { return supply_rail(1.8); },
        placed(room_.at(area_.x0, 1.45, room_.depth() * 0.5), quarter));
  }

  void add_on_walls() {
    const double beside = room_.door + (room_.door > x_at(0.5) ? -0.85 : 0.85),
                 face = room_.inward > 0 ? 0 : 2 * quarter;
    if (!room_.open_front) {
      placer_.put(
          "light switch", [] { return light_switch(); }, placed(room_.at(beside, 1.1, partition / 2), face));
      placer_.put(
          "thermostat", [] { return thermostat(); }, placed(room_.at(beside, 1.45, partition / 2), face));
    }
    const int sockets = std::max(2, static_cast<int>(room_.depth() / 2.2));
    for (int i = 0; i < sockets; ++i) {
      const double t = 1.9 + (room_.depth() - 3.6) * (i + 0.5) / sockets;
      placer_.put(
          "double socket", [] { return double_socket(); }, placed(room_.at(area_.x0, 0.35, t), quarter));
      placer_.put(
          "double socket", [] { return double_socket(); }, placed(room_.at(area_.x1, 0.35, t), -quarter));
    }
    if (random_.chance(0.3))
      placer_.put(
          "fire extinguisher", [] { return fire_extinguisher(); },
          placed(room_.at(beside + (beside < room_.door ? -0.3 : 0.3), 0.5, partition / 2), face));
  }

  const HospitalRoom& room_;
  Rect area_;
  Random random_;
  Placer placer_;
};

}  // namespace

void add_room_services(ObjectScene& scene, const HospitalRoom& room, Random random) {
  RoomServices(scene, room, random).add();
}

}  // namespace triptych
