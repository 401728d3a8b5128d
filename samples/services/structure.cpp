#include "samples/services/structure.hpp"

#include "samples/placing.hpp"
#include "samples/services/furniture_parts.hpp"
#include "samples/services/part_tools.hpp"
#include "samples/services/structure_parts.hpp"
#include "samples/solids.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <limits>

namespace triptych {
namespace {

using namespace hospital;

constexpr double quarter = glm::half_pi<double>();

/// "wall 4400x2950 1000-2200x2150": equal walls share a mesh.
std::string wall_name(const char* kind, double length, double height, const std::vector<Rect>& holes) {
  std::string name = fmt::format("{} {:.0f}x{:.0f}", kind, length * 1000, height * 1000);
  for (const Rect& hole : holes)
    name += fmt::format(" {:.0f}-{:.0f}x{:.0f}", hole.x0 * 1000, hole.x1 * 1000, hole.z1 * 1000);
  return name;
}

glm::dvec3 floor_colour(RoomUse use) {
  switch (use) {
    case RoomUse::ward:
      return {0.34, 0.42, 0.44};
    case RoomUse::treatment:
    case RoomUse::laboratory:
      return {0.40, 0.44, 0.36};
    case RoomUse::lavatory:
      return {0.50, 0.52, 0.54};
    case RoomUse::lounge:
      return {0.42, 0.34, 0.26};
    default:
      return {0.32, 0.31, 0.30};
  }
}

class Structure {
 public:
  Structure(ObjectScene& scene, const std::vector<HospitalRoom>& rooms, int storey)
      : scene_(scene), rooms_(rooms), storey_(storey) {}

  void add() {
    for (size_t i = 0; i < rooms_.size(); ++i)
      add_room(rooms_[i], i + 1 < rooms_.size() ? &rooms_[i + 1] : nullptr);
    for (int i = 0; i < 2; ++i) add_corridor(i);
    add_cross_corridor(blocks[0][1], blocks[1][0]);
    add_ends();
  }

 private:
  Placer placer(const std::string& place) const { return {scene_, storey_, place}; }

  /// Along x from `from`, or along z towards smaller z from there; people pass below holes that reach the
  /// floor.
  void add_wall(const std::string& place, const char* kind, const glm::dvec2& from, bool along_x,
                double length, double height, double thickness, const std::vector<Rect>& holes) {
    const bool outside = thickness == facade;
    placer(place).put(
        wall_name(kind, length, height, holes),
        [&] { return wall(length, height, thickness, holes, outside); },
        placed({from.x, 0, from.y}, along_x ? 0 : quarter), Footprint::none);
    std::vector<double> stops{0};
    for (const Rect& hole : holes)
      if (hole.z0 <= 0) stops.insert(stops.end(), {hole.x0, hole.x1});
    stops.push_back(length);
    constexpr double skirting = 0.012;
    const double half = thickness / 2 + skirting;
    for (size_t i = 0; i + 1 < stops.size(); i += 2)
      scene_.block(storey_,
                   along_x ? Rect{from.x + stops[i], from.y - half, from.x + stops[i + 1], from.y + half}
                           : Rect{from.x - half, from.y - stops[i + 1], from.x + half, from.y - stops[i]});
  }

  /// A frame, and a leaf that stands open, along `into`.
  void add_door(const std::string& place, const glm::dvec2& middle, bool along_x, double into, int variant) {
    const Placer room = placer(place);
    room.put(
        "door frame", [] { return door_frame(); }, placed({middle.x, 0, middle.y}, along_x ? 0 : quarter),
        Footprint::none);
    constexpr double half = door_width / 2, jamb = door_jamb, deep = partition / 2 + 0.015;
    for (const double side : {-half, half - jamb})
      scene_.block(storey_,
                   along_x ? Rect{middle.x + side, middle.y - deep, middle.x + side + jamb, middle.y + deep}
                           : Rect{middle.x - deep, middle.y + side, middle.x + deep, middle.y + side + jamb});
    const double hinge = half - jamb - 0.03;
    const glm::dvec3 at = along_x ? glm::dvec3(middle.x - hinge, 0, middle.y + into * 0.06)
                                  : glm::dvec3(middle.x + into * 0.06, 0, middle.y + hinge);
    // The leaf runs along z; a quarter turn takes z to x.
    const double turn = along_x ? (into > 0 ? 0 : 2 * quarter) : (into > 0 ? quarter : -quarter);
    room.put(
        fmt::format("door leaf {}", variant + 1), [=] { return door_leaf(variant); }, placed(at, turn));
  }

  void add_room(const HospitalRoom& room, const HospitalRoom* next) {
    const Rect& grid = room.grid;
    const std::string place = room.name + " " + room_use_name(room.use);
    const Placer here = placer(place);
    const bool well = room.use == RoomUse::shaft || room.use == RoomUse::stairs;
    const double height = well ? slab_underside : partition_top;
    if (!well) {
      const glm::dvec3 covering = floor_colour(room.use);
      here.put(
          fmt::format("slab {} {:.0f}x{:.0f}", room_use_name(room.use), grid.width() * 1000,
                      grid.depth() * 1000),
          [&] { return floor_slab(grid.width(), grid.depth(), covering); }, placed({grid.x0, 0, grid.z0}, 0));
    } else {
      scene_.block(storey_, grid);
    }
    if (room.ceiling && !well) add_ceiling(here, room.area());
    add_corridor_wall(room, place, height);
    // The wall to the room in the east, of the higher of both.
    if (next && next->grid.z0 == grid.z0 && next->grid.x0 == grid.x1) {
      const bool next_well = next->use == RoomUse::shaft || next->use == RoomUse::stairs;
      add_side_wall(room, place, grid.x1, well || next_well ? slab_underside : partition_top,
                    room.door_to_next);
    } else if (grid.x1 < width) {
      add_side_wall(room, place, grid.x1, height, false);
    }
    // Shafts stand at the western ends of their blocks.
    if (room.use == RoomUse::shaft && grid.x0 > 0) add_side_wall(room, place, grid.x0, height, false);
    if (room.outer) add_facade(room, place);
    if (!room.outer && room.corridor == 0)
      add_wall(place, well ? "shaft wall" : "wall", {grid.x0, depth / 2}, true, grid.width(), height,
               partition, {});
    if (room.use == RoomUse::stairs)
      here.put(
          "stairs", [&] { return stair(room.area().width(), room.area().depth()); },
          room.inward > 0 ? placed({room.area().x0, 0, room.area().z0}, 0)
                          : placed({room.area().x1, 0, room.area().z1}, 2 * quarter));
  }

  static void add_ceiling(const Placer& here, const Rect& area) {
    here.put(
        fmt::format("ceiling {:.0f}x{:.0f}", area.width() * 1000, area.depth() * 1000),
        [&] { return suspended_ceiling(area.width(), area.depth()); }, placed({area.x0, 0, area.z0}, 0));
  }

  void add_corridor_wall(const HospitalRoom& room, const std::string& place, double height) {
    const Rect& grid = room.grid;
    std::vector<Rect> holes;
    if (room.open_front) {
      holes = {{0.5, 0, grid.width() - 0.5, 2.5}};
    } else if (room.use != RoomUse::shaft) {
      const double door = room.door - grid.x0;
      holes = {{door - door_width / 2, 0, door + door_width / 2, door_height}};
      add_door(place, {room.door, room.corridor_wall}, true, room.inward, static_cast<int>(room.use) % 3);
    }
    add_wall(place, height > partition_top ? "shaft wall" : "wall", {grid.x0, room.corridor_wall}, true,
             grid.width(), height, partition, holes);
  }

  void add_side_wall(const HospitalRoom& room, const std::string& place, double x, double height, bool door) {
    const Rect& grid = room.grid;
    std::vector<Rect> holes;
    if (door) {
      const double middle = room.corridor_wall + room.inward * room.next_door_at(), along = grid.z1 - middle;
      holes = {{along - door_width / 2, 0, along + door_width / 2, door_height}};
      add_door(place, {x, middle}, false, 1, 0);
    }
    add_wall(place, height > partition_top ? "shaft wall" : "wall", {x, grid.z1}, false, grid.depth(), height,
             partition, holes);
  }

  void add_facade(const HospitalRoom& room, const std::string& place) {
    const Rect& grid = room.grid;
    const int windows = std::max(1, static_cast<int>(grid.width() / 2.1));
    std::vector<Rect> holes;
    const double z = room.inward < 0 ? -facade / 2 : depth + facade / 2;
    for (int i = 0; i < windows; ++i) {
      const double middle = grid.width() * (i + 0.5) / windows;
      holes.push_back({middle - window_width / 2, window_sill, middle + window_width / 2, window_top});
      placer(place).put(
          "window", [] { return window_frame(); }, placed({grid.x0 + middle, 0, z}, 0));
    }
    add_wall(place, "facade", {grid.x0, z}, true, grid.width(), storey, facade, holes);
  }

  void add_corridor(int number) {
    const double z0 = corridor_z[number] - corridor / 2;
    constexpr int bays = 8;
    for (int i = 0; i < bays; ++i) {
      const double length = width / bays, x = length * i;
      const Placer here = placer(fmt::format("{}.corridor {} bay {}", storey_, number + 1, i + 1));
      here.put(
          fmt::format("slab corridor {:.0f}x{:.0f}", length * 1000, corridor * 1000),
          [&] {
            return floor_slab(length, corridor, {0.30, 0.35, 0.38});
          },
          placed({x, 0, z0}, 0));
      if (has_ceiling(storey_, x + length / 2))
        add_ceiling(here, {x, z0 + partition / 2, x + length, z0 + corridor - partition / 2});
    }
  }

  void add_cross_corridor(double x0, double x1) {
    const double z0 = corridor_z[0] + corridor / 2, z1 = corridor_z[1] - corridor / 2;
    constexpr int bays = 3;
    for (int i = 0; i < bays; ++i) {
      const double length = (z1 - z0) / bays, z = z0 + length * i;
      const Placer here = placer(fmt::format("{}.cross corridor {:.0f} bay {}", storey_, x0, i + 1));
      here.put(
          fmt::format("slab corridor {:.0f}x{:.0f}", (x1 - x0) * 1000, length * 1000),
          [&] {
            return floor_slab(x1 - x0, length, {0.30, 0.35, 0.38});
          },
          placed({x0, 0, z}, 0));
      if (has_ceiling(storey_, (x0 + x1) / 2))
        add_ceiling(here, {x0 + partition / 2, z, x1 - partition / 2, z + length});
    }
  }

  /// The outer walls in the west and east; a wide opening at each corridor's end, down to the floor.
  void add_ends() {
    for (const double x : {-facade / 2, width + facade / 2}) {
      const std::string place = fmt::format("{}.{} end", storey_, x < 0 ? "west" : "east");
      for (int half = 0; half < 2; ++half) {
        const double z1 = half ? depth + facade : depth / 2, z0 = half ? depth / 2 : -facade;
        const double middle = z1 - corridor_z[half];
        std::vector<Rect> holes{{middle - 0.9, 0, middle + 0.9, 2.5}};
        for (const double at : {-6.0, 4.0})
          holes.push_back(
              {middle + at - window_width / 2, window_sill, middle + at + window_width / 2, window_top});
        std::sort(holes.begin(), holes.end(), [](const Rect& a, const Rect& b) { return a.x0 < b.x0; });
        add_wall(place, half ? "end facade south" : "end facade north", {x, z1}, false, z1 - z0, storey,
                 facade, holes);
        for (const double at : {-6.0, 4.0})
          placer(place).put(
              "window", [] { return window_frame(); }, placed({x, 0, z1 - middle - at}, quarter));
      }
    }
  }

  ObjectScene& scene_;
  const std::vector<HospitalRoom>& rooms_;
  int storey_;
};

}  // namespace

void add_structure(ObjectScene& scene, const std::vector<HospitalRoom>& rooms, int storey) {
  Structure(scene, rooms, storey).add();
}

void add_roof_and_ground(ObjectScene& scene, int storeys, Random random) {
  const Placer roof{scene, storeys - 1, "roof"}, ground{scene, 0, "ground"};
  constexpr int bays = 4;
  constexpr double length = width / bays;
  for (int i = 0; i < bays; ++i)
    for (int k = 0; k < 2; ++k) {
      roof.put(
          "roof slab",
          [] {
            return floor_slab(length, depth / 2, {0.36, 0.37, 0.38});
          },
          placed({length * i, storey, depth / 2 * k}, 0));
      const auto variant = static_cast<int>(random.below(4));
      const FurnitureModel unit = air_handler(variant);
      roof.put(unit.name, unit.make,
               placed({length * (i + 0.5), storey, depth / 2 * (k + 0.5)}, random.chance(0.5) ? 0 : quarter));
    }
  roof.put(
      "parapet",
      [] {
        return MeshParts{pierced_box({-facade, storey, -facade},
                                     {width + facade, storey + 0.8, depth + facade}, 1,
                                     {{0, 0, width, depth}}, {0.60, 0.56, 0.50})};
      },
      glm::dmat4(1));
  ground.put(
      "ground",
      [] {
        return MeshParts{pierced_box({-60, -0.5, -60}, {width + 60, 0, depth + 60}, 1,
                                     {Rect{0, 0, width, depth}.grown(facade)}, {0.13, 0.22, 0.06})};
      },
      glm::dmat4(1));
}

}  // namespace triptych
