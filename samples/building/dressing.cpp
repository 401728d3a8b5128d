#include "samples/building/dressing.hpp"

#include "samples/building/dressing_images.hpp"
#include "samples/placing.hpp"
#include "samples/solids.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>

namespace triptych {

namespace {

using namespace measures;

// Streams of random numbers.
enum : uint64_t { for_pictures, for_curtains };

constexpr double picture_width = 0.8, picture_height = 0.6, picture_middle = 1.55;
constexpr double lamp_length = 1.2, lamp_depth = 0.3, lamp_spacing = 3.2;
constexpr double rod_height = 2.62, curtain_width = 0.5;

std::string image(const std::string& name) { return std::string(images_folder) + "/" + name; }

/// A rectangle in the plane z = 0 that looks along z.
MeshPart sheet(double x0, double y0, double x1, double y1, const std::string& texture) {
  MeshPart part;
  part.colour = glm::dvec3(1);
  part.texture = texture;
  for (const auto& [u, v] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    part.positions.emplace_back(x0 + u * (x1 - x0), y0 + v * (y1 - y0), 0);
    part.texture_places.emplace_back(u, 1 - v);
  }
  part.indices = {0, 1, 2, 0, 2, 3};
  return part;
}

/// Hangs from its origin down; a housing, and a face that glows.
std::vector<MeshPart> lamp() {
  constexpr double x = lamp_length / 2, z = lamp_depth / 2, rim = 0.025;
  MeshPart face = box({-x + rim, -0.062, -z + rim}, {x - rim, -0.05, z - rim}, {0.9, 0.9, 0.88});
  face.emission = {1.0, 0.96, 0.88};
  return {box({-x, -0.05, -z}, {x, 0, z}, {0.7, 0.7, 0.7}), face};
}

/// Its back is at z = 0, and it looks along z.
std::vector<MeshPart> picture(int number) {
  constexpr double w = picture_width / 2, h = picture_height / 2, rim = 0.035;
  const glm::dvec3 frames[] = {{0.08, 0.05, 0.03}, {0.30, 0.22, 0.10}, {0.04, 0.04, 0.04}};
  MeshPart canvas = sheet(-w + rim, -h + rim, w - rim, h - rim, image(picture_image(number)));
  for (glm::vec3& position : canvas.positions) position.z = 0.012f;
  return {pierced_box({-w, -h, 0}, {w, h, 0.025}, 2, {{-w + rim, -h + rim, w - rim, h - rim}},
                      frames[number % 3]),
          canvas};
}

/// Cloth in folds, from so high up to the rod.
MeshPart curtain(double bottom) {
  constexpr int folds = 5, steps = 8 * folds;
  MeshPart part;
  part.colour = glm::dvec3(1);
  part.texture = image(curtain_image);
  part.cut_out = true;
  for (int i = 0; i <= steps; ++i) {
    const double u = i / static_cast<double>(steps),
                 fold = 0.035 * std::sin(u * folds * glm::two_pi<double>());
    for (const double v : {0.0, 1.0}) {
      part.positions.emplace_back((u - 0.5) * curtain_width, bottom + v * (rod_height - bottom), fold);
      part.texture_places.emplace_back(u * 3, 1 - v);
    }
  }
  for (uint32_t i = 0; i < steps; ++i) {
    for (const uint32_t corner : {0u, 2u, 3u, 0u, 3u, 1u}) part.indices.push_back(2 * i + corner);
  }
  return part;
}

class Dresser {
 public:
  Dresser(const FloorPlan& plan, const Furniture& furniture,
          const std::vector<FurniturePlacement>& placements, const Random& random)
      : plan_(plan), random_(random), standing_(plan.rooms.size()) {
    for (const FurniturePlacement& placement : placements) {
      const bool lamp = is_ceiling_lamp(furniture.pieces[placement.piece], placement);
      if (!lamp) standing_[static_cast<size_t>(placement.room)].push_back(placement);
    }
    for (const Wall& wall : plan.walls) {
      for (const Opening& opening : wall.openings) {
        if (opening.kind != OpeningKind::door) continue;
        const int room = opening.leaf_to_high ? wall.high_room : wall.low_room;
        if (room >= 0)
          standing_[static_cast<size_t>(room)].push_back(
              {.footprint = leaf_footprint(wall, opening), .bottom = 0, .top = door_height});
      }
    }
  }

  Dressing make() {
    lamps_ = {"lamp", lamp(), {}, {}};
    for (int i = 0; i < picture_images; ++i)
      pictures_.push_back({fmt::format("picture {}", i), picture(i), {}, {}});
    long_curtains_ = {"curtain", {curtain(0.06)}, {}, {}};
    short_curtains_ = {"short curtain", {curtain(window_sill - 0.12)}, {}, {}};
    rods_ = {"curtain rod",
             {box({-1.15, rod_height - 0.012, -0.012}, {1.15, rod_height + 0.012, 0.012}, {0.2, 0.2, 0.2})},
             {},
             {}};
    constexpr double half = window_width / 2 - 0.02;
    MeshPart slats = sheet(-half, window_sill + 0.45, half, window_top - 0.03, image(blind_image));
    slats.cut_out = true;
    blinds_ = {"blind", {slats}, {}, {}};
    for (size_t i = 0; i < plan_.rooms.size(); ++i) hang_lamps(plan_.rooms[i], standing_[i]);
    for (size_t i = 0; i < plan_.walls.size(); ++i) {
      dress_windows(plan_.walls[i], random_.fork(for_curtains).fork(i));
      hang_pictures(plan_.walls[i], random_.fork(for_pictures).fork(i));
    }
    for (ShellObject* const object : {&lamps_, &long_curtains_, &short_curtains_, &rods_, &blinds_})
      add(*object);
    for (ShellObject& object : pictures_) add(object);
    return std::move(result_);
  }

 private:
  using Standing = std::vector<FurniturePlacement>;

  void add(ShellObject& object) {
    if (!object.places.empty()) result_.objects.push_back(std::move(object));
  }

  static bool is_clear(const Standing& standing, const Rect& area, double bottom, double top) {
    return std::ranges::none_of(standing, [&](const FurniturePlacement& other) {
      return other.top > bottom && other.bottom < top && other.footprint.overlaps(area);
    });
  }

  void hang_lamps(const Room& room, const Standing& standing) {
    const Rect& area = room.area;
    const auto count = [](double length) {
      return std::max(1, static_cast<int>(std::lround(length / lamp_spacing)));
    };
    const int columns = count(area.width()), rows = count(area.depth());
    const bool turned = area.width() < area.depth();
    const double x = (turned ? lamp_depth : lamp_length) / 2, z = (turned ? lamp_length : lamp_depth) / 2;
    std::vector<Rect> open;
    if (room.floor + 1 < plan_.floors && room.type == RoomType::hall) open = {hall_void()};
    if (room.floor + 1 < plan_.floors && room.type == RoomType::stairs) open = stair_voids();
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const glm::dvec2 at(area.x0 + area.width() * (column + 0.5) / columns,
                            area.z0 + area.depth() * (row + 0.5) / rows);
        const Rect own{at.x - x, at.y - z, at.x + x, at.y + z};
        if (!area.contains(own) || !is_clear(standing, own, ceiling - 0.1, ceiling)) continue;
        if (std::ranges::any_of(open, [&](const Rect& hole) { return hole.overlaps(own); })) continue;
        const glm::dvec3 place(at.x, floor_level(room.floor) + ceiling, at.y);
        lamps_.places.push_back(placed(place, turned ? glm::half_pi<double>() : 0));
        result_.lights.push_back({place - glm::dvec3(0, 0.09, 0), room.floor});
      }
    }
  }

  /// A turn that has z point into the room on one side of the wall.
  static double into(const Wall& wall, bool high_side) {
    const double turn = wall.along_x ? 0 : glm::half_pi<double>();
    return high_side ? turn : turn + glm::pi<double>();
  }

  void dress_windows(const Wall& wall, Random random) {
    if (wall.low_room >= 0 && wall.high_room >= 0) return;
    const bool high_side = wall.low_room < 0;
    const auto number = static_cast<size_t>(high_side ? wall.high_room : wall.low_room);
    const RoomType type = plan_.rooms[number].type;
    const bool bare = type == RoomType::corridor || type == RoomType::hall || type == RoomType::stairs ||
                      type == RoomType::store || type == RoomType::lavatory;
    const double choice = random.uniform();  // the same for all windows of a wall
    if (bare || choice < 0.2) return;
    const Standing& standing = standing_[number];
    const Rect& f = wall.footprint;
    const double level = floor_level(wall.floor), sign = high_side ? 1 : -1;
    for (const Opening& opening : wall.openings) {
      if (opening.kind != OpeningKind::window) continue;
      const double middle = (opening.from + opening.to) / 2;
      const double centre = wall.along_x ? (f.z0 + f.z1) / 2 : (f.x0 + f.x1) / 2;
      const auto at = [&](double along, double inwards) {
        return wall.along_x ? glm::dvec3(along, level, centre + sign * inwards)
                            : glm::dvec3(centre + sign * inwards, level, along);
      };
      const auto clear = [&](double from, double to, double bottom) {
        constexpr double face = outer_wall / 2, deep = 0.14;
        const double near = centre + sign * face, far = near + sign * deep;
        const double low = std::min(near, far), high = std::max(near, far);
        const Rect area = wall.along_x ? Rect{from, low, to, high} : Rect{low, from, high, to};
        return is_clear(standing, area, bottom, rod_height);
      };
      const double turn = into(wall, high_side);
      if (!clear(opening.from, opening.to, window_sill + 0.3)) continue;  // something hangs there already
      if (choice < 0.45) {
        blinds_.places.push_back(placed(at(middle, 0.1), turn));
        continue;
      }
      constexpr double reach = 1.0, off = 0.08;
      const double from = middle - reach, to = middle + reach;
      const bool falls = clear(from, to, 0.06);
      if (!falls && !clear(from, to, window_sill - 0.12)) continue;
      if (from < (wall.along_x ? f.x0 : f.z0) || to > (wall.along_x ? f.x1 : f.z1)) continue;
      rods_.places.push_back(placed(at(middle, outer_wall / 2 + off), turn));
      for (const double side : {-1.0, 1.0})
        (falls ? long_curtains_ : short_curtains_)
            .places.push_back(placed(at(middle + side * 0.74, outer_wall / 2 + off), turn));
    }
  }

  static bool has_pictures(RoomType type) {
    return type == RoomType::office || type == RoomType::corridor || type == RoomType::lounge ||
           type == RoomType::meeting_room || type == RoomType::hall || type == RoomType::library ||
           type == RoomType::open_office || type == RoomType::kitchen;
  }

  void hang_pictures(const Wall& wall, Random random) {
    for (const bool high_side : {false, true}) {
      const int number = high_side ? wall.high_room : wall.low_room;
      if (number < 0) continue;
      const Room& room = plan_.rooms[static_cast<size_t>(number)];
      if (!has_pictures(room.type)) continue;
      const Rect &f = wall.footprint, &area = room.area;
      const double face = wall.along_x ? (high_side ? f.z1 : f.z0) : (high_side ? f.x1 : f.x0);
      const double first = std::max(wall.along_x ? f.x0 : f.z0, wall.along_x ? area.x0 : area.z0) + 0.3,
                   last = std::min(wall.along_x ? f.x1 : f.z1, wall.along_x ? area.x1 : area.z1) - 0.3;
      const double spacing = room.type == RoomType::corridor ? 4.5 : 2.6;
      for (double along = first + picture_width / 2 + random.between(0, 1.2);
           along + picture_width / 2 < last; along += spacing + random.between(-0.6, 0.6))
        hang_picture(wall, static_cast<size_t>(number), high_side, face, along, random);
    }
  }

  void hang_picture(const Wall& wall, size_t room, bool high_side, double face, double along,
                    Random& random) {
    constexpr double half = picture_width / 2, away = 0.06;
    const double from = along - half - 0.1, to = along + half + 0.1;
    for (const Opening& opening : wall.openings)
      if (opening.to > from && opening.from < to) return;
    const double low = high_side ? face : face - away, high = low + away;
    const Rect area = wall.along_x ? Rect{from, low, to, high} : Rect{low, from, high, to};
    constexpr double bottom = picture_middle - picture_height / 2 - 0.12,
                     top = picture_middle + picture_height / 2 + 0.05;
    if (!is_clear(standing_[room], area, bottom, top)) return;
    const double level = floor_level(wall.floor) + picture_middle, out = high_side ? 0.003 : -0.003;
    const glm::dvec3 place =
        wall.along_x ? glm::dvec3(along, level, face + out) : glm::dvec3(face + out, level, along);
    pictures_[random.below(picture_images)].places.push_back(placed(place, into(wall, high_side)));
  }

  const FloorPlan& plan_;
  Random random_;
  std::vector<Standing> standing_;  ///< by room; open doors stand there too
  ShellObject lamps_, long_curtains_, short_curtains_, rods_, blinds_;
  std::vector<ShellObject> pictures_;
  Dressing result_;
};

}  // namespace

bool is_ceiling_lamp(const FurniturePiece& piece, const FurniturePlacement& placement) {
  return piece.category == "Lights" && placement.top > ceiling - 0.1;
}

Dressing make_dressing(const FloorPlan& plan, const Furniture& furniture,
                       const std::vector<FurniturePlacement>& placements, const Random& random) {
  return Dresser(plan, furniture, placements, random).make();
}

}  // namespace triptych
