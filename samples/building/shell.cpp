#include "samples/building/shell.hpp"

#include "samples/building/stairs.hpp"
#include "samples/placing.hpp"
#include "samples/solids.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using namespace measures;

const glm::dvec3 white(0.78, 0.77, 0.73), facade_colour(0.52, 0.34, 0.24), concrete(0.42, 0.42, 0.41),
    wood(0.30, 0.17, 0.08), frame_colour(0.62, 0.62, 0.62), metal(0.25, 0.26, 0.28), grass(0.13, 0.22, 0.06),
    skirting_colour(0.22, 0.20, 0.18);

glm::dvec3 floor_colour(RoomType type) {
  switch (type) {
    case RoomType::corridor:
      return {0.33, 0.31, 0.28};
    case RoomType::hall:
      return {0.40, 0.36, 0.30};
    case RoomType::stairs:
      return {0.36, 0.36, 0.35};
    case RoomType::kitchen:
      return {0.44, 0.30, 0.20};
    case RoomType::lavatory:
      return {0.48, 0.52, 0.55};
    case RoomType::classroom:
    case RoomType::computer_room:
      return {0.20, 0.26, 0.34};
    case RoomType::meeting_room:
    case RoomType::library:
      return {0.30, 0.12, 0.10};
    default:
      return {0.26, 0.28, 0.24};
  }
}

glm::dvec3 wall_colour(const FloorPlan& plan, const Wall& wall) {
  constexpr double tints[][3] = {
      {0.78, 0.77, 0.73}, {0.72, 0.74, 0.64}, {0.66, 0.72, 0.76}, {0.78, 0.68, 0.58}};
  for (const int side : {wall.low_room, wall.high_room}) {
    const RoomType type = plan.rooms[static_cast<size_t>(side)].type;
    if (type == RoomType::corridor || type == RoomType::hall || type == RoomType::office) return white;
  }
  const auto& tint = tints[static_cast<size_t>(plan.rooms[static_cast<size_t>(wall.high_room)].type) % 4];
  return {tint[0], tint[1], tint[2]};
}

std::vector<glm::dmat4> once() { return {glm::dmat4(1)}; }

class Shell {
 public:
  explicit Shell(const FloorPlan& plan) : plan_(plan) {}

  std::vector<ShellObject> make() {
    for (const Room& room : plan_.rooms) add_room(room);
    for (size_t i = 0; i < plan_.walls.size(); ++i) add_wall(plan_.walls[i], i);
    add_shared_objects();
    add_surroundings();
    return std::move(objects_);
  }

 private:
  void add(std::string name, std::vector<MeshPart> parts, std::optional<int> storey) {
    objects_.push_back({std::move(name), std::move(parts), once(), storey});
  }
  void add_shared(std::string name, std::vector<MeshPart> parts, std::vector<glm::dmat4> places) {
    if (!places.empty()) objects_.push_back({std::move(name), std::move(parts), std::move(places), {}});
  }

  void add_room(const Room& room) {
    const double level = floor_level(room.floor);
    const Rect &grid = room.grid, &area = room.area;
    const std::string name = room.name + " " + room_type_name(room.type);
    add(name + " floor",
        {pierced_box({grid.x0, level - slab, grid.z0}, {grid.x1, level, grid.z1}, 1, room.voids,
                     floor_colour(room.type))},
        room.floor);
    const bool top = room.floor + 1 == plan_.floors;
    std::vector<Rect> above;
    if (!top && room.type == RoomType::hall) above = {hall_void()};
    if (!top && room.type == RoomType::stairs)
      for (const Rect& hole : stair_voids())
        if (grid.contains(hole)) above = {hole};
    add(name + " ceiling",
        {pierced_box({area.x0, level + ceiling, area.z0}, {area.x1, level + ceiling + ceiling_panel, area.z1},
                     1, above, white)},
        room.floor);
    if (top) {
      const double roof = floor_level(plan_.floors);
      add(name + " roof", {box({grid.x0, roof - slab, grid.z0}, {grid.x1, roof, grid.z1}, concrete)},
          room.floor);
    }
    if (room.type == RoomType::hall)
      for (const Rect& hole : room.voids) add(name + " railing", {railing(hole, level)}, room.floor);
    if (room.type == RoomType::stairs)
      for (const Rect& hole : room.voids) add(name + " railing", {stair_railing(hole, level)}, room.floor);
    if (!room.partitions.empty()) add(name + " partitions", {partitions(room, level)}, room.floor);
    if (room.type == RoomType::stairs && !top)
      (grid.x0 < width / 2 ? west_stairs_ : east_stairs_).push_back(placed({0, level, 0}, 0));
  }

  static MeshPart railing(const Rect& hole, double level) {
    MeshPart part;
    part.colour = metal;
    for (const Rect& side : railing_footprints(hole))
      append(part, box({side.x0, level, side.z0}, {side.x1, level + 1.05, side.z1}, metal));
    return part;
  }

  static MeshPart partitions(const Room& room, double level) {
    MeshPart part;
    part.colour = {0.30, 0.38, 0.46};
    for (const Rect& side : room.partitions)
      append(part, box({side.x0, level + 0.12, side.z0}, {side.x1, level + partition_height, side.z1},
                       part.colour));
    return part;
  }

  // The side towards the arriving flight stays open.
  static MeshPart stair_railing(const Rect& hole, double level) {
    MeshPart part;
    part.colour = metal;
    const double x = hole.x0 < width / 2 ? hole.x0 - 0.06 : hole.x1;
    append(part, box({x, level, hole.z0}, {x + 0.06, level + 1.05, hole.z1}, metal));
    return part;
  }

  void add_wall(const Wall& wall, size_t number) {
    const double level = floor_level(wall.floor);
    const Rect& f = wall.footprint;
    std::vector<Rect> holes;
    for (const Opening& opening : wall.openings)
      holes.push_back({opening.from, level + opening.bottom, opening.to, level + opening.top});
    const int axis = wall.along_x ? 2 : 0;
    const glm::dvec3 low(f.x0, level + wall.bottom, f.z0), high(f.x1, level + wall.top, f.z1);
    std::vector<MeshPart> parts;
    const bool outer = wall.low_room < 0 || wall.high_room < 0;
    if (outer) {
      // Bricks outside, plaster inside.
      constexpr double plaster = 0.05;
      glm::dvec3 brick_low = low, brick_high = high, plaster_low = low, plaster_high = high;
      if (wall.low_room < 0) {
        brick_high[axis] = plaster_low[axis] = high[axis] - plaster;
      } else {
        brick_low[axis] = plaster_high[axis] = low[axis] + plaster;
      }
      if (wall.along_x) {  // the corners are bricks
        plaster_low.x = std::max(plaster_low.x, 0.0);
        plaster_high.x = std::min(plaster_high.x, width);
      }
      parts = {pierced_box(brick_low, brick_high, axis, holes, facade_colour),
               pierced_box(plaster_low, plaster_high, axis, holes, white)};
    } else {
      parts = {pierced_box(low, high, axis, holes, wall_colour(plan_, wall))};
    }
    add(fmt::format("{}.w{} {}", wall.floor, number, outer ? "facade" : "wall"), std::move(parts),
        wall.floor);
    for (const Opening& opening : wall.openings) add_opening(wall, opening, level);
    for (const int side : {wall.low_room, wall.high_room})
      if (side >= 0) add_skirting(wall, side == wall.high_room, level, number);
  }

  void add_opening(const Wall& wall, const Opening& opening, double level) {
    const double along = (opening.from + opening.to) / 2;
    const Rect& f = wall.footprint;
    const glm::dvec3 middle = wall.along_x ? glm::dvec3(along, level, (f.z0 + f.z1) / 2)
                                           : glm::dvec3((f.x0 + f.x1) / 2, level, along);
    const double turn = wall.along_x ? 0 : glm::half_pi<double>();
    if (opening.kind == OpeningKind::window) {
      windows_.push_back(placed(middle, turn));
    } else if (opening.kind == OpeningKind::door) {
      frames_.push_back(placed(middle, turn));
      const Rect leaf = leaf_footprint(wall, opening);
      const double flip = opening.leaf_to_high ? 0 : glm::pi<double>();
      leaves_.push_back(placed({leaf.centre().x, level, leaf.centre().y}, turn + flip));
    }
  }

  void add_skirting(const Wall& wall, bool high_side, double level, size_t number) {
    constexpr double thickness = 0.012, tall = 0.08;
    const Rect& f = wall.footprint;
    const Room& room = plan_.rooms[static_cast<size_t>(high_side ? wall.high_room : wall.low_room)];
    const double face = wall.along_x ? (high_side ? f.z1 : f.z0) : (high_side ? f.x1 : f.x0);
    const double low = high_side ? face : face - thickness, high = low + thickness;
    std::vector<double> stops{
        std::max(wall.along_x ? f.x0 : f.z0, wall.along_x ? room.area.x0 : room.area.z0)};
    for (const Opening& opening : wall.openings) {
      if (opening.kind == OpeningKind::window) continue;
      stops.push_back(opening.from);
      stops.push_back(opening.to);
    }
    stops.push_back(std::min(wall.along_x ? f.x1 : f.z1, wall.along_x ? room.area.x1 : room.area.z1));
    MeshPart part;
    part.colour = skirting_colour;
    for (size_t i = 0; i + 1 < stops.size(); i += 2) {
      if (stops[i + 1] - stops[i] < 0.02) continue;
      append(part, wall.along_x
                       ? box({stops[i], level, low}, {stops[i + 1], level + tall, high}, part.colour)
                       : box({low, level, stops[i]}, {high, level + tall, stops[i + 1]}, part.colour));
    }
    if (!part.indices.empty()) add(fmt::format("{} skirting {}", room.name, number), {part}, wall.floor);
  }

  void add_shared_objects() {
    const double leaf = door_width - 2 * door_frame;
    MeshPart handles = box({-0.09, 1.02, leaf / 2 - 0.14}, {0.09, 1.05, leaf / 2 - 0.11}, metal);
    for (const double x : {-0.09, 0.07})
      append(handles, box({x, 1.02, leaf / 2 - 0.24}, {x + 0.02, 1.05, leaf / 2 - 0.14}, metal));
    add_shared("door leaf",
               {box({-door_leaf / 2, 0.01, -leaf / 2},
                    {door_leaf / 2, door_height - door_frame - 0.005, leaf / 2}, wood),
                handles},
               leaves_);
    const double half = door_width / 2, deep = inner_wall / 2 + 0.01;
    add_shared(
        "door frame",
        {pierced_box({-half, 0, -deep}, {half, door_height, deep}, 2,
                     {{-half + door_frame, 0, half - door_frame, door_height - door_frame}}, frame_colour)},
        frames_);
    const double w = window_width / 2, bar = 0.05;
    MeshPart frame = pierced_box({-w, window_sill, -0.04}, {w, window_top, 0.04}, 2,
                                 {{-w + bar, window_sill + bar, -bar / 2, window_top - bar},
                                  {bar / 2, window_sill + bar, w - bar, window_top - bar}},
                                 frame_colour);
    const double reach = outer_wall / 2 + 0.04;
    const MeshPart sill =
        box({-w + 0.002, window_sill + 0.002, -reach}, {w - 0.002, window_sill + 0.03, -0.04}, concrete);
    MeshPart sills = sill;
    append(sills,
           box({-w + 0.002, window_sill + 0.002, 0.04}, {w - 0.002, window_sill + 0.03, reach}, concrete));
    add_shared("window", {frame, sills}, windows_);
    add_shared("west stairs", stair_flights(stair_voids()[0], true), west_stairs_);
    add_shared("east stairs", stair_flights(stair_voids()[1], false), east_stairs_);
  }

  void add_surroundings() {
    add("ground", {box({-60, -0.6, -60}, {width + 60, -slab, depth + 60}, grass)}, std::nullopt);
    const double roof = floor_level(plan_.floors);
    add("roof parapet",
        {pierced_box({-outer_wall, roof - slab, -outer_wall},
                     {width + outer_wall, roof + 0.9, depth + outer_wall}, 1, {{0, 0, width, depth}},
                     facade_colour)},
        plan_.floors - 1);
  }

  const FloorPlan& plan_;
  std::vector<ShellObject> objects_;
  std::vector<glm::dmat4> leaves_, frames_, windows_, west_stairs_, east_stairs_;
};

}  // namespace

std::optional<int> ShellObject::storey_of(const glm::dmat4& place) const {
  if (places.size() == 1 && place == glm::dmat4(1)) return storey;
  return static_cast<int>(std::lround(place[3].y / measures::storey));
}

std::vector<Rect> railing_footprints(const Rect& hole) {
  constexpr double t = 0.06;
  return {{hole.x0 - t, hole.z0 - t, hole.x1 + t, hole.z0},
          {hole.x0 - t, hole.z1, hole.x1 + t, hole.z1 + t},
          {hole.x0 - t, hole.z0, hole.x0, hole.z1},
          {hole.x1, hole.z0, hole.x1 + t, hole.z1}};
}

std::vector<ShellObject> make_shell(const FloorPlan& plan) { return Shell(plan).make(); }

}  // namespace triptych
