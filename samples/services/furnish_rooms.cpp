#include "samples/services/furnish_rooms.hpp"

#include "samples/placing.hpp"
#include "samples/services/furniture_parts.hpp"
#include "samples/services/pipe_parts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace triptych {
namespace {

using namespace hospital;

constexpr double quarter = glm::half_pi<double>();

/// The wall that a piece stands against.
enum class Wall { west, east, corridor, far };

class RoomFurnisher {
 public:
  RoomFurnisher(ObjectScene& scene, const HospitalRoom& room, const Random& random)
      : room_(room),
        area_(room.area().grown(-0.02)),
        random_(random),
        placer_{scene, room.storey, room.name + " " + room_use_name(room.use)} {
    keep_doors_free();
    if (room.outer) add_taken(0, room.depth() - 0.2, area_.width(), room.depth());  // radiators
  }

  void furnish() {
    switch (room_.use) {
      case RoomUse::ward:
        return furnish_ward();
      case RoomUse::office:
        return furnish_office();
      case RoomUse::treatment:
        return furnish_treatment();
      case RoomUse::laboratory:
        return furnish_laboratory();
      case RoomUse::store:
        return furnish_store();
      case RoomUse::lavatory:
        return furnish_lavatory();
      case RoomUse::lounge:
        return furnish_lounge();
      case RoomUse::plant_room:
        return furnish_plant_room();
      default:
        return;
    }
  }

 private:
  int variant() { return static_cast<int>(random_.below(4)); }

  void add_taken(double x0, double t0, double x1, double t1) {
    const double a = room_.at(0, 0, t0).z, b = room_.at(0, 0, t1).z;
    taken_.push_back({area_.x0 + x0, std::min(a, b), area_.x0 + x1, std::max(a, b)});
  }

  void keep_doors_free() {
    if (room_.use == RoomUse::lounge) {
      add_taken(0, 0, area_.width(), 1.0);
    } else {
      const double door = room_.door - area_.x0;
      add_taken(door - 0.75, 0, door + 0.75, 1.7);
    }
    // A door from the room in the west may be there, and one to the east: nothing stands before either.
    const double next = room_.next_door_at();
    add_taken(0, next - 0.8, 1.4, next + 0.8);
    if (room_.door_to_next) add_taken(area_.width() - 0.9, next - 0.8, area_.width(), next + 0.8);
  }

  bool fits(const Rect& rect) const {
    return area_.contains(rect) && std::none_of(taken_.begin(), taken_.end(),
                                                [&](const Rect& other) { return other.overlaps(rect); });
  }

  /// At a place, its back turned as a piece's along that wall.
  std::optional<Rect> put_at(const FurnitureModel& piece, const glm::dvec2& centre, Wall wall,
                             double height = 0) {
    const bool turned = wall == Wall::west || wall == Wall::east;
    const glm::dvec2 half = (turned ? glm::dvec2(piece.size.y, piece.size.x) : piece.size) / 2.0;
    const Rect rect{centre.x - half.x, centre.y - half.y, centre.x + half.x, centre.y + half.y};
    if (height == 0) {
      if (!fits(rect)) return {};
      taken_.push_back(rect);
    }
    // A piece's back is towards -z; a quarter turn takes it to -x.
    const bool north = (wall == Wall::corridor) == (room_.inward > 0);
    const double angle = wall == Wall::west   ? quarter
                         : wall == Wall::east ? -quarter
                         : north              ? 0
                                              : 2 * quarter;
    placer_.put(piece.name, piece.make, placed({centre.x, height, centre.y}, angle));
    return rect;
  }

  /// The first free place along a wall, from `from` metres on: from the corridor along the side walls, from
  /// the west along the others. Returns its middle.
  std::optional<glm::dvec2> put_along(const FurnitureModel& piece, Wall wall, double from,
                                      double gap = 0.02) {
    const bool side = wall == Wall::west || wall == Wall::east;
    const double length = side ? room_.depth() : area_.width(), half = piece.size.x / 2,
                 deep = piece.size.y / 2 + gap;
    for (double along = from + half; along + half < length; along += 0.1) {
      glm::dvec2 centre;
      if (side) {
        centre = {wall == Wall::west ? area_.x0 + deep : area_.x1 - deep,
                  room_.at(0, 0, along + partition / 2).z};
      } else {
        centre = {area_.x0 + along, room_
                                        .at(0, 0,
                                            wall == Wall::corridor ? partition / 2 + 0.02 + deep
                                                                   : room_.depth() + partition / 2 - 0.02 -
                                                                         deep - (room_.outer ? 0.2 : 0))
                                        .z};
      }
      if (put_at(piece, centre, wall)) return centre;
    }
    return {};
  }

  void put_basin() {
    const bool western = room_.door > area_.x0 + area_.width() / 2;
    put_along(wash_basin(variant()), western ? Wall::west : Wall::east, 0.75, 0.1);
  }

  void furnish_ward() {
    put_basin();
    const int kind = variant();
    const int beds = room_.depth() > 7 ? 3 : 2;
    for (int i = 0; i < beds; ++i) {
      const auto at = put_along(bed(kind), Wall::west, 2.0 + 0.4 * i, 0.06);
      if (!at) break;
      put_along(bedside_table(variant()), Wall::west, 2.2);
      const glm::dvec2 beside(at->x + 0.7, at->y + 0.85);
      put_at(drip_stand(0), beside, Wall::west);
    }
    put_along(cabinet(1 + 2 * (variant() % 2)), Wall::east, 1.8);
    put_along(table(variant()), Wall::east, 3.0);
    put_along(chair(kind), Wall::east, 2.5);
    put_along(chair(kind), Wall::east, 4.5);
    put_along(armchair(variant()), Wall::east, 5.0);
    put_along(stool(variant()), Wall::east, 3.0);
    put_along(trolley(variant()), Wall::west, 2.0);
    put_along(trolley(variant()), Wall::east, 3.5);
    put_along(waste_bin(variant()), Wall::corridor, 0);
  }

  void put_workplace(Wall wall, double from) {
    const FurnitureModel piece = desk(variant());
    const auto at = put_along(piece, wall, from);
    if (!at) return;
    const double out = wall == Wall::west ? 1 : -1;
    put_at(office_chair(variant()), {at->x + out * 0.78, at->y},
           wall == Wall::west ? Wall::east : Wall::west);
    put_at(monitor(variant()), {at->x - out * 0.15, at->y}, wall, 0.74);
    if (random_.chance(0.5)) put_at(monitor(variant()), {at->x - out * 0.15, at->y + 0.55}, wall, 0.74);
    put_at(keyboard(0), {at->x + out * 0.15, at->y}, wall, 0.74);
  }

  void furnish_office() {
    put_basin();
    put_workplace(Wall::east, 1.9);
    put_workplace(Wall::west, 1.9);
    if (room_.depth() > 7) put_workplace(Wall::east, 4.2);
    put_along(cabinet(variant()), Wall::west, 1.8);
    put_along(shelf(variant()), Wall::east, 1.8);
    put_along(shelf(variant()), Wall::west, 1.8);
    put_along(chair(variant()), Wall::east, 3);
    put_along(waste_bin(variant()), Wall::west, 2);
    put_meeting();
  }

  /// A table in the middle with chairs at its long sides.
  void put_meeting() {
    const glm::dvec2 middle(area_.x0 + area_.width() / 2, room_.at(0, 0, room_.depth() * 0.62).z);
    const int kind = variant();
    if (!put_at(table(2), middle, Wall::far)) return;
    const double away = room_.inward * 0.72;
    for (const double x : {-0.35, 0.35}) {
      put_at(chair(kind), {middle.x + x, middle.y + away}, Wall::far);
      put_at(chair(kind), {middle.x + x, middle.y - away}, Wall::corridor);
    }
  }

  void furnish_treatment() {
    put_basin();
    FurnitureModel lying = couch(variant());
    put_at(lying, {area_.x0 + area_.width() / 2 + 0.3, room_.at(0, 0, room_.depth() * 0.58).z}, Wall::far);
    put_workplace(Wall::east, 1.9);
    put_along(trolley(variant()), Wall::west, 2.0);
    put_along(cabinet(variant()), Wall::east, 3.2);
    put_along(cabinet(variant()), Wall::west, 2.5);
    put_along(stool(variant()), Wall::east, 5);
    put_along(stool(variant()), Wall::west, 4);
    put_along(trolley(variant()), Wall::west, 3.5);
    put_along(waste_bin(variant()), Wall::corridor, 0);
    put_along(drip_stand(0), Wall::east, 2);
  }

  void furnish_laboratory() {
    put_basin();
    const int kind = variant();
    for (const Wall wall : {Wall::west, Wall::east})
      for (int i = 0; i < 2; ++i)
        if (const auto at = put_along(bench(kind), wall, 1.8)) {
          const double out = wall == Wall::west ? 1 : -1;
          put_at(stool(variant()), {at->x + out * 0.7, at->y + 0.3}, wall);
          put_at(monitor(variant()), {at->x - out * 0.1, at->y - 0.4}, wall, 0.92);
          put_at(keyboard(0), {at->x + out * 0.2, at->y - 0.4}, wall, 0.92);
        }
    // An island in the middle, two benches back to back.
    const double x = area_.x0 + area_.width() / 2;
    if (area_.width() > 4.8)
      for (const double side : {-1.0, 1.0}) {
        const glm::dvec2 at(x + side * 0.39, room_.at(0, 0, room_.depth() * 0.55).z);
        if (!put_at(bench(2), at, side < 0 ? Wall::east : Wall::west)) continue;
        for (const double z : {-0.6, 0.6})
          put_at(stool(variant()), {at.x + side * 0.7, at.y + z}, Wall::west);
      }
    put_along(shelf(variant()), Wall::far, 1.5);
    put_along(cabinet(variant()), Wall::far, 0.2);
  }

  void furnish_store() {
    for (const Wall wall : {Wall::west, Wall::east, Wall::far})
      for (int i = 0; i < 6; ++i) put_along(shelf(variant()), wall, wall == Wall::far ? 0.6 : 1.0);
    put_along(trolley(variant()), Wall::east, 1.5);
  }

  void furnish_lavatory() {
    for (int i = 0; i < 3; ++i) put_along(toilet(0), Wall::west, 1.8 + 1.0 * i, 0.05);
    for (int i = 0; i < 3; ++i) put_along(wash_basin(variant()), Wall::east, 1.8 + 0.2 * i, 0.04);
    put_along(waste_bin(variant()), Wall::east, 1.8);
    put_along(cabinet(0), Wall::far, 0.2);
  }

  void furnish_lounge() {
    const int kind = variant();
    for (double t = 1.7; t < room_.depth() - 1.2; t += 1.7)
      for (double x = 1.5; x < area_.width() - 0.6; x += 0.62)
        put_at(chair(kind), {area_.x0 + x, room_.at(0, 0, t).z}, Wall::far);
    for (int i = 0; i < 3; ++i) put_along(armchair(kind), Wall::east, 1.2);
    put_along(cabinet(variant()), Wall::east, 1.2);
    put_along(table(variant()), Wall::west, 1.2);
    put_along(waste_bin(variant()), Wall::west, 1.2);
  }

  void furnish_plant_room() {
    put_at(air_handler(variant()), {area_.x0 + area_.width() / 2, room_.at(0, 0, room_.depth() * 0.72).z},
           Wall::far);
    const FurnitureModel vessel{"tank", {1.1, 1.1}, [] { return tank(1.0, 1.8); }};
    const FurnitureModel pump_set{"pump", {0.7, 0.75}, [] { return pump(0.3); }};
    for (int i = 0; i < 2; ++i) put_along(vessel, Wall::west, 1.0);
    for (int i = 0; i < 4; ++i) put_along(pump_set, Wall::east, 1.0);
    for (int i = 0; i < 2; ++i) put_along(pump_set, Wall::far, 0.2);
    put_along(cabinet(3), Wall::east, 1.0);
  }

  const HospitalRoom& room_;
  Rect area_;
  Random random_;
  Placer placer_;
  std::vector<Rect> taken_;
};

}  // namespace

void furnish_room(ObjectScene& scene, const HospitalRoom& room, Random random) {
  RoomFurnisher(scene, room, random).furnish();
}

}  // namespace triptych
