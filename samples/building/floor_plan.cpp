#include "samples/building/floor_plan.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {
namespace {

using namespace measures;

// Bands from north to south: offices, corridor, inner rooms, spine, inner rooms, corridor, offices.
constexpr std::array<double, 8> band_edges{0, 5.5, 8.1, 16.5, 23.5, 31.9, 34.5, 40};
constexpr double half_wall = inner_wall / 2;
const std::vector<double> corridor_breaks{0, 19.5, 40.5, 60};
const std::vector<double> inner_breaks{0, 7.5, 10, 19.5, 28.75, 31.25, 40.5, 50, 52.5, 60};
const std::vector<double> spine_breaks{0, 7.5, 10, 16, 20.5, 39.5, 44, 50, 52.5, 60};

bool is_corridor_band(size_t band) { return band == 1 || band == 5; }
bool is_inner_band(size_t band) { return band == 2 || band == 4; }

/// Offices of different widths; none of their walls runs into a corridor's fire door.
std::vector<double> office_breaks(Random& random) {
  const std::vector<double> widths{3.1, 3.1, 3.6, 3.6, 4.2, 4.8, 6.0, 7.4};
  std::vector<double> breaks{0};
  while (width - breaks.back() > 3.0) {
    double next = breaks.back() + random.pick(widths);
    for (const double fire_wall : {19.5, 40.5})
      if (std::abs(next - fire_wall) < 1.5) next = fire_wall;
    breaks.push_back(width - next < 3.0 ? width : next);
  }
  breaks.back() = width;
  return breaks;
}

RoomType spine_type(size_t index) {
  constexpr std::array types{RoomType::kitchen,  RoomType::corridor, RoomType::stairs,
                             RoomType::lavatory, RoomType::hall,     RoomType::lavatory,
                             RoomType::stairs,   RoomType::corridor, RoomType::lounge};
  return types.at(index);
}

RoomType inner_type(size_t index, Random& random) {
  if (index == 1 || index == 4 || index == 7) return RoomType::corridor;
  const std::vector<RoomType> at_windows{RoomType::open_office, RoomType::meeting_room, RoomType::lounge,
                                         RoomType::kitchen};
  const std::vector<RoomType> within{RoomType::classroom,   RoomType::classroom,     RoomType::computer_room,
                                     RoomType::open_office, RoomType::open_office,   RoomType::meeting_room,
                                     RoomType::library,     RoomType::computer_room, RoomType::games_room};
  return random.pick(index == 0 || index == 8 ? at_windows : within);
}

RoomType outer_type(double room_width, Random& random) {
  if (room_width > 6.5) return random.chance(0.5) ? RoomType::meeting_room : RoomType::open_office;
  if (random.chance(0.06)) return RoomType::store;
  if (random.chance(0.06)) return RoomType::copy_room;
  if (random.chance(0.08)) return RoomType::meeting_room;
  return RoomType::office;
}

struct Band {
  std::vector<double> breaks;
  std::vector<int> rooms;  // numbers in the plan
};

class Planner {
 public:
  Planner(FloorPlan& plan, int floor, Random random) : plan_(plan), floor_(floor), random_(random) {}

  void add_floor() {
    for (size_t band = 0; band < bands_.size(); ++band) add_rooms(band);
    for (size_t band = 0; band < bands_.size(); ++band) add_cross_walls(band);
    for (size_t band = 0; band + 1 < bands_.size(); ++band) add_long_walls(band);
    add_facade(0, false);
    add_facade(bands_.size() - 1, true);
  }

 private:
  Room& room(int number) { return plan_.rooms[static_cast<size_t>(number)]; }
  RoomType type(int number) { return number < 0 ? RoomType::store : room(number).type; }
  bool circulation(int number) {
    return type(number) == RoomType::corridor || type(number) == RoomType::hall;
  }

  void add_rooms(size_t number) {
    Band& band = bands_[number];
    if (is_corridor_band(number)) {
      band.breaks = corridor_breaks;
    } else if (is_inner_band(number)) {
      band.breaks = inner_breaks;
    } else {
      band.breaks = number == 3 ? spine_breaks : office_breaks(random_);
    }
    for (size_t i = 0; i + 1 < band.breaks.size(); ++i) {
      Room added;
      added.floor = floor_;
      added.grid = {band.breaks[i], band_edges[number], band.breaks[i + 1], band_edges[number + 1]};
      added.area = {added.grid.x0 + (i == 0 ? 0 : half_wall), added.grid.z0 + (number == 0 ? 0 : half_wall),
                    added.grid.x1 - (i + 2 == band.breaks.size() ? 0 : half_wall),
                    added.grid.z1 - (number + 1 == bands_.size() ? 0 : half_wall)};
      if (is_corridor_band(number)) {
        added.type = RoomType::corridor;
      } else if (is_inner_band(number)) {
        added.type = inner_type(i, random_);
      } else {
        added.type = number == 3 ? spine_type(i) : outer_type(added.grid.width(), random_);
      }
      added.name = fmt::format("{}.{}{:02}", floor_, number + 1, i + 1);
      if (floor_ > 0 && added.type == RoomType::hall) added.voids = {hall_void()};
      if (floor_ > 0 && added.type == RoomType::stairs) {
        for (const Rect& opening : stair_voids())
          if (added.grid.contains(opening)) added.voids = {opening};
      }
      if (added.type == RoomType::lavatory) add_partitions(added);
      band.rooms.push_back(static_cast<int>(plan_.rooms.size()));
      plan_.rooms.push_back(added);
    }
  }

  // The stalls are at the wall away from the hall.
  static void add_partitions(Room& lavatory) {
    constexpr double thickness = 0.03;
    const Rect& area = lavatory.area;
    const double x0 = area.x0 < width / 2 ? area.x0 : area.x1 - stall_depth;
    for (double z = area.z0 + stall_width; z < area.z1 - stall_width / 2; z += stall_width)
      lavatory.partitions.push_back({x0, z - thickness / 2, x0 + stall_depth, z + thickness / 2});
  }

  Wall wall(bool along_x, const Rect& footprint, int low, int high) const {
    const bool outer = low < 0 || high < 0;
    return {floor_, along_x, footprint, outer ? -slab : 0, storey - slab, low, high, {}};
  }

  Opening door(double middle, bool leaf_to_high) {
    return {OpeningKind::door, middle - door_width / 2, middle + door_width / 2, 0, door_height,
            leaf_to_high,      random_.chance(0.5)};
  }

  static Opening passage(double middle, double clear_width, double height) {
    return {
        OpeningKind::passage, middle - clear_width / 2, middle + clear_width / 2, 0, height, false, false};
  }

  // Windows at equal distances; the ground floor's corridors end in a way out.
  void add_windows(Wall& facade, double from, double to, int inside) {
    const double middle = (from + to) / 2;
    if (type(inside) == RoomType::corridor && floor_ == 0) {
      facade.openings.push_back(passage(middle, 1.8, 2.4));
      return;
    }
    const int count = static_cast<int>((to - from - 0.3) / (window_width + 0.4));
    for (int i = 0; i < count; ++i) {
      const double at = from + (to - from) * (i + 0.5) / count;
      facade.openings.push_back({OpeningKind::window, at - window_width / 2, at + window_width / 2,
                                 window_sill, window_top, false, false});
    }
  }

  // Walls along z, between the rooms of one band and at its two ends.
  void add_cross_walls(size_t number) {
    const Band& band = bands_[number];
    for (size_t i = 0; i <= band.rooms.size(); ++i) {
      const int low = i == 0 ? -1 : band.rooms[i - 1];
      const int high = i == band.rooms.size() ? -1 : band.rooms[i];
      const double x = band.breaks[i];
      const Rect inner = room(low < 0 ? high : low).area;
      if (low < 0 || high < 0) {
        // The facade goes on past the inner walls, up to its own neighbours.
        const Rect span = room(low < 0 ? high : low).grid;
        Wall facade = wall(false, {low < 0 ? -outer_wall : x, span.z0, low < 0 ? 0 : x + outer_wall, span.z1},
                           low, high);
        add_windows(facade, inner.z0, inner.z1, low < 0 ? high : low);
        plan_.walls.push_back(facade);
        continue;
      }
      Wall between = wall(false, {x - half_wall, inner.z0, x + half_wall, inner.z1}, low, high);
      const double middle = (inner.z0 + inner.z1) / 2;
      if (is_corridor_band(number)) {
        between.openings.push_back(passage(middle, 1.8, 2.3));
      } else if (number == 3 && (circulation(low) != circulation(high))) {
        between.openings.push_back(door(type(low) == RoomType::stairs || type(high) == RoomType::stairs
                                            ? inner.z1 - 0.9
                                            : middle + random_.between(-1.5, 1.5),
                                        circulation(low)));
      }
      plan_.walls.push_back(between);
    }
  }

  // Walls along x between two bands: a piece for each pair of neighbours.
  void add_long_walls(size_t number) {
    const Band &north = bands_[number], &south = bands_[number + 1];
    const double z = band_edges[number + 1];
    std::vector<std::pair<double, int>> best(plan_.rooms.size(), {0.0, -1});
    for (const int low : north.rooms) {
      for (const int high : south.rooms) {
        const double from = std::max(room(low).grid.x0, room(high).grid.x0);
        const double to = std::min(room(low).grid.x1, room(high).grid.x1);
        if (to <= from) continue;
        Wall between = wall(true, {from, z - half_wall, to, z + half_wall}, low, high);
        const bool low_way = circulation(low), high_way = circulation(high);
        if (low_way && high_way) {
          const double clear = std::min(2.0, to - from - 0.4);
          if (clear > 1) between.openings.push_back(passage((from + to) / 2, clear, 2.5));
        } else if (low_way != high_way && (is_corridor_band(number) || is_corridor_band(number + 1))) {
          const auto inside = static_cast<size_t>(low_way ? high : low);
          if (to - from > best[inside].first)
            best[inside] = {to - from, static_cast<int>(plan_.walls.size())};
        }
        plan_.walls.push_back(between);
      }
    }
    for (const auto& [length, at] : best)
      if (at >= 0) add_doors(plan_.walls[static_cast<size_t>(at)]);
  }

  // A room's doors are in its longest wall to a corridor: one, or two for rooms where many people sit.
  void add_doors(Wall& between) {
    const bool leaf_to_high = circulation(between.low_room);
    const double from = between.footprint.x0 + half_wall + 0.75, to = between.footprint.x1 - half_wall - 0.75;
    if (to - from > 6) {
      between.openings.push_back(door(from + 0.2, leaf_to_high));
      between.openings.push_back(door(to - 0.2, leaf_to_high));
    } else {
      between.openings.push_back(door(random_.chance(0.5) ? from + 0.1 : to - 0.1, leaf_to_high));
    }
  }

  void add_facade(size_t number, bool south) {
    const Band& band = bands_[number];
    for (size_t i = 0; i < band.rooms.size(); ++i) {
      const int inside = band.rooms[i];
      const Rect& grid = room(inside).grid;
      const double west = grid.x0 - (i == 0 ? outer_wall : 0);
      const double east = grid.x1 + (i + 1 == band.rooms.size() ? outer_wall : 0);
      const double z0 = south ? depth : -outer_wall;
      Wall facade = wall(true, {west, z0, east, z0 + outer_wall}, south ? inside : -1, south ? -1 : inside);
      add_windows(facade, room(inside).area.x0, room(inside).area.x1, inside);
      plan_.walls.push_back(facade);
    }
  }

  FloorPlan& plan_;
  int floor_;
  Random random_;
  std::array<Band, 7> bands_;
};

}  // namespace

const char* room_type_name(RoomType type) {
  constexpr std::array names{"office",    "open office", "classroom", "computer room", "meeting room",
                             "kitchen",   "lavatory",    "lounge",    "library",       "store",
                             "copy room", "games room",  "corridor",  "hall",          "stairs"};
  return names.at(static_cast<size_t>(type));
}

Rect leaf_footprint(const Wall& wall, const Opening& door) {
  const double length = door_width - 2 * door_frame;
  const double low = wall.along_x ? wall.footprint.z0 : wall.footprint.x0;
  const double high = wall.along_x ? wall.footprint.z1 : wall.footprint.x1;
  const double along = door.hinge_at_to ? door.to - door_frame - door_leaf : door.from + door_frame;
  const double across = door.leaf_to_high ? high : low - length;
  if (wall.along_x) return {along, across, along + door_leaf, across + length};
  return {across, along, across + length, along + door_leaf};
}

Rect hall_void() { return {23.5, 18.6, 36.5, 21.4}; }

std::vector<Rect> stair_voids() { return {{13.15, 17.35, 15.925, 21.5}, {44.075, 17.35, 46.85, 21.5}}; }

FloorPlan make_floor_plan(int floors, const Random& random) {
  if (floors < 1 || floors > max_floors)
    fail("sample building", "{} floors; 1 to {} can be built", floors, max_floors);
  FloorPlan plan;
  plan.floors = floors;
  for (int floor = 0; floor < floors; ++floor)
    Planner(plan, floor, random.fork(static_cast<uint64_t>(floor))).add_floor();
  return plan;
}

}  // namespace triptych
