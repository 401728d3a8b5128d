#include "samples/services/hospital_plan.hpp"

#include <cmath>
#include <fmt/core.h>

namespace triptych {
namespace {

using namespace hospital;

/// A room's use, how often it is chosen, and its least and greatest width.
struct Kind {
  RoomUse use;
  double share, narrow, wide;
};

const std::vector<Kind> outer_kinds{{RoomUse::ward, 0.56, 4.4, 6.4},
                                    {RoomUse::office, 0.20, 3.2, 4.4},
                                    {RoomUse::treatment, 0.14, 4.0, 5.2},
                                    {RoomUse::lounge, 0.10, 5.5, 7.5}};
const std::vector<Kind> core_kinds{
    {RoomUse::treatment, 0.34, 4.0, 5.4},  {RoomUse::laboratory, 0.24, 5.2, 7.6},
    {RoomUse::store, 0.14, 2.8, 4.2},      {RoomUse::lavatory, 0.14, 2.6, 3.6},
    {RoomUse::plant_room, 0.06, 6.0, 7.6}, {RoomUse::lounge, 0.08, 4.8, 6.4}};

const Kind& pick(const std::vector<Kind>& kinds, Random& random) {
  double left = random.uniform();
  for (const Kind& kind : kinds)
    if ((left -= kind.share) < 0) return kind;
  return kinds.front();
}

struct Strip {
  double z0, z1, corridor_wall, inward;
  int corridor;
  bool outer;
};

const Strip strips[] = {{0, corridor_z[0] - corridor / 2, corridor_z[0] - corridor / 2, -1, 0, true},
                        {corridor_z[0] + corridor / 2, depth / 2, corridor_z[0] + corridor / 2, 1, 0, false},
                        {depth / 2, corridor_z[1] - corridor / 2, corridor_z[1] - corridor / 2, -1, 1, false},
                        {corridor_z[1] + corridor / 2, depth, corridor_z[1] + corridor / 2, 1, 1, true}};

class Planner {
 public:
  Planner(int storey, const Random& random) : storey_(storey), random_(random) {}

  std::vector<HospitalRoom> plan() {
    for (const Strip& strip : strips) {
      if (strip.outer) {
        fill(strip, 0, width);
        continue;
      }
      for (const auto& [from, to] : blocks) {
        add(strip, {RoomUse::shaft, 1, shaft_width, shaft_width}, from, from + shaft_width);
        const bool stairs = (from == 0) == (strip.corridor == 1);
        constexpr double stairs_width = 3.4;
        fill(strip, from + shaft_width, stairs ? to - stairs_width : to);
        if (stairs) add(strip, {RoomUse::stairs, 1, 0, 0}, to - stairs_width, to);
      }
    }
    join_rooms();
    return std::move(rooms_);
  }

 private:
  /// Rooms side by side, stretched so that the last one ends at `to`.
  void fill(const Strip& strip, double from, double to) {
    std::vector<Kind> kinds;
    std::vector<double> widths;
    double sum = 0;
    while (sum < to - from - 2) {
      kinds.push_back(pick(strip.outer ? outer_kinds : core_kinds, random_));
      widths.push_back(random_.between(kinds.back().narrow, kinds.back().wide));
      sum += widths.back();
    }
    double at = from;
    for (size_t i = 0; i < kinds.size(); ++i) {
      constexpr double module = 0.05;
      const double next =
          i + 1 == kinds.size() ? to : std::round((at + widths[i] * (to - from) / sum) / module) * module;
      add(strip, kinds[i], at, next);
      at = next;
    }
  }

  void add(const Strip& strip, const Kind& kind, double x0, double x1) {
    HospitalRoom room;
    room.storey = storey_;
    room.use = kind.use;
    room.name = fmt::format("{}.{:03}", storey_, rooms_.size() + 1);
    room.grid = {x0, strip.z0, x1, strip.z1};
    room.corridor = strip.corridor;
    room.corridor_wall = strip.corridor_wall;
    room.inward = strip.inward;
    room.outer = strip.outer;
    room.ceiling = has_ceiling(storey_, (x0 + x1) / 2) && kind.use != RoomUse::plant_room;
    room.open_front = kind.use == RoomUse::lounge;
    const double reach = room.open_front ? (x1 - x0) / 2 : 1.0;
    room.door = random_.chance(0.5) ? x0 + reach : x1 - reach;
    rooms_.push_back(std::move(room));
  }

  void join_rooms() {
    const auto suits = [](const HospitalRoom& room) {
      return room.use == RoomUse::ward || room.use == RoomUse::treatment || room.use == RoomUse::laboratory ||
             room.use == RoomUse::office;
    };
    for (size_t i = 0; i + 1 < rooms_.size(); ++i) {
      const HospitalRoom& next = rooms_[i + 1];
      const bool beside = next.grid.x0 == rooms_[i].grid.x1 && next.grid.z0 == rooms_[i].grid.z0;
      rooms_[i].door_to_next = beside && suits(rooms_[i]) && suits(next) && random_.chance(0.4);
    }
  }

  int storey_;
  Random random_;
  std::vector<HospitalRoom> rooms_;
};

}  // namespace

const char* room_use_name(RoomUse use) {
  constexpr const char* names[] = {"ward",     "office", "treatment",  "laboratory", "store",
                                   "lavatory", "lounge", "plant room", "shaft",      "stairs"};
  return names[static_cast<size_t>(use)];
}

std::vector<HospitalRoom> plan_storey(int storey, Random random) { return Planner(storey, random).plan(); }

}  // namespace triptych
