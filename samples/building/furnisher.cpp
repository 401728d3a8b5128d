#include "samples/building/furnisher.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using namespace measures;

constexpr size_t nobody = SIZE_MAX;
constexpr double door_way = 1.15, window_air = 0.4;

/// Sine and cosine, exact at quarter turns.
glm::dvec2 sine_cosine(double angle) {
  const double quarters = angle / glm::half_pi<double>();
  if (std::abs(quarters - std::round(quarters)) > 1e-9) return {std::sin(angle), std::cos(angle)};
  switch (((static_cast<int>(std::round(quarters)) % 4) + 4) % 4) {
    case 0:
      return {0, 1};
    case 1:
      return {1, 0};
    case 2:
      return {0, -1};
    default:
      return {-1, 0};
  }
}

Rect turned_footprint(const glm::dvec3& size, glm::dvec2 centre, double angle) {
  const glm::dvec2 turn = glm::abs(sine_cosine(angle));
  const double half_x = (size.x * turn.y + size.z * turn.x) / 2,
               half_z = (size.x * turn.x + size.z * turn.y) / 2;
  return {centre.x - half_x, centre.y - half_z, centre.x + half_x, centre.y + half_z};
}

}  // namespace

glm::dmat4 placement_transform(const FurniturePlacement& placement) {
  const glm::dvec2 turn = sine_cosine(placement.angle);
  glm::dmat4 transform(1);
  transform[0] = {turn.y, 0, -turn.x, 0};
  transform[2] = {turn.x, 0, turn.y, 0};
  transform[3] = {placement.position, 1};
  return transform;
}

double facing_from(Side side) {
  switch (side) {
    case Side::north:
      return 0;
    case Side::east:
      return -glm::half_pi<double>();
    case Side::south:
      return glm::pi<double>();
    case Side::west:
      return glm::half_pi<double>();
  }
  return 0;
}

Side opposite(Side side) { return static_cast<Side>((static_cast<int>(side) + 2) % 4); }

Furnisher::Furnisher(const Supply& supply, const FloorPlan& plan, int room, Random random)
    : supply_(supply), plan_(plan), room_(room), random_(random) {
  keep_openings_free();
}

void Furnisher::keep_openings_free() {
  const Room& here = room();
  for (const Wall& wall : plan_.walls) {
    if (wall.low_room != room_ && wall.high_room != room_) continue;
    const bool inside_is_high = wall.high_room == room_;
    const Side side = wall.along_x ? (inside_is_high ? Side::north : Side::south)
                                   : (inside_is_high ? Side::west : Side::east);
    for (const Opening& opening : wall.openings) {
      const bool window = opening.kind == OpeningKind::window;
      const double reach = window ? window_air : door_way, beside = window ? 0 : 0.1;
      const double face = wall.along_x ? (inside_is_high ? here.area.z0 : here.area.z1)
                                       : (inside_is_high ? here.area.x0 : here.area.x1);
      const double near = inside_is_high ? face : face - reach, far = near + reach;
      const double from = opening.from - beside, to = opening.to + beside;
      const Rect zone = wall.along_x ? Rect{from, near, to, far} : Rect{near, from, far, to};
      if (window) {
        windows_.push_back({side, (from + to) / 2, zone});
      } else {
        keep_free(zone, 0, opening.top + 0.1);
        doors_[static_cast<size_t>(side)] = true;
      }
    }
  }
  for (const Rect& partition : here.partitions) keep_free(partition, 0, partition_height);
  for (const Rect& hole : here.voids) keep_free(hole.grown(0.12), 0, storey);
  if (here.floor + 1 < plan_.floors && here.type == RoomType::hall)
    keep_free(hall_void().grown(0.05), 2.0, storey);
  if (here.type == RoomType::stairs) {
    for (const Rect& stair : stair_voids()) keep_free(stair.grown(0.3), 0, storey);
  }
}

std::optional<size_t> Furnisher::choose(FurnitureRole role,
                                        const std::function<bool(const FurniturePiece&)>& passes) {
  std::vector<std::pair<size_t, double>> weighted;
  double sum = 0;
  for (const size_t candidate : supply_.pools[role]) {
    if (supply_.triangles[candidate] == 0 || (passes && !passes(piece(candidate)))) continue;
    sum += std::exp(-supply_.thrift * static_cast<double>(supply_.triangles[candidate]) / 4000);
    weighted.emplace_back(candidate, sum);
  }
  const double drawn =
      random_.uniform() * sum;  // drawn also where there is no choice, so that streams stay in step
  for (const auto& [candidate, up_to] : weighted)
    if (drawn < up_to) return candidate;
  if (weighted.empty()) return std::nullopt;
  return weighted.back().first;
}

bool Furnisher::is_free(const Rect& footprint, double bottom, double top, size_t except) const {
  if (!area().contains(footprint) || top > ceiling + 1e-9) return false;
  constexpr double touch = 1e-6;
  const auto meets = [&](const Rect& other, double other_bottom, double other_top) {
    return bottom < other_top - touch && top > other_bottom + touch &&
           footprint.overlaps(other.grown(-touch));
  };
  for (const KeptFree& zone : kept_free_)
    if (meets(zone.area, zone.bottom, zone.top)) return false;
  for (const WindowPlace& window : windows_)
    if (!before_windows_ && meets(window.air, window_sill + 0.02, window_top + 0.1)) return false;
  for (size_t i = 0; i < placements_.size(); ++i)
    if (i != except && meets(placements_[i].footprint, placements_[i].bottom, placements_[i].top))
      return false;
  return true;
}

bool Furnisher::add(size_t number, glm::dvec2 centre, double angle, double bottom, size_t except) {
  const FurniturePiece& added = piece(number);
  const Rect footprint = turned_footprint(added.size, centre, angle);
  if (!is_free(footprint, bottom, bottom + added.size.y, except)) return false;
  placements_.push_back({number,
                         {centre.x, floor_level(room().floor) + bottom, centre.y},
                         angle,
                         room_,
                         footprint,
                         bottom,
                         bottom + added.size.y});
  return true;
}

bool Furnisher::put(size_t number, glm::dvec2 centre, double angle, double bottom) {
  return add(number, centre, angle, bottom, nobody);
}

glm::dvec2 Furnisher::wall_span(Side side) const {
  if (side == Side::north || side == Side::south) return {area().x0, area().x1};
  return {area().z0, area().z1};
}

bool Furnisher::put_at_wall(size_t number, Side side, double along, double bottom, double gap) {
  const double away = piece(number).size.z / 2 + gap;
  glm::dvec2 centre;
  switch (side) {
    case Side::north:
      centre = {along, area().z0 + away};
      break;
    case Side::south:
      centre = {along, area().z1 - away};
      break;
    case Side::west:
      centre = {area().x0 + away, along};
      break;
    case Side::east:
      centre = {area().x1 - away, along};
      break;
  }
  return put(number, centre, facing_from(side), bottom);
}

bool Furnisher::put_somewhere_at_wall(size_t number, Side side, double bottom, double gap) {
  const double half = piece(number).size.x / 2 + 0.03;
  const glm::dvec2 span = wall_span(side);
  const double length = span.y - span.x - 2 * half;
  if (length < 0) return false;
  const double start = random_.uniform() * length, step = 0.17;
  for (double offset = 0; offset <= length; offset += step)
    if (put_at_wall(number, side, span.x + half + std::fmod(start + offset, length + 1e-9), bottom, gap))
      return true;
  return false;
}

std::vector<Side> Furnisher::shuffled_sides() {
  std::vector<Side> sides{Side::north, Side::east, Side::south, Side::west};
  random_.shuffle(sides);
  return sides;
}

bool Furnisher::has_door(Side side) const { return doors_[static_cast<size_t>(side)]; }

bool Furnisher::put_somewhere(size_t number, double bottom, double gap) {
  for (const Side side : shuffled_sides())
    if (put_somewhere_at_wall(number, side, bottom, gap)) return true;
  return false;
}

bool Furnisher::put_in_window(size_t number, const WindowPlace& window) {
  before_windows_ = true;
  const double bottom = std::max(0.02, window_top + 0.1 - piece(number).size.y);
  const bool fitted = put_at_wall(number, window.side, window.along, bottom, 0.002);
  before_windows_ = false;
  return fitted;
}

bool Furnisher::plays(size_t number, FurnitureRole role) const {
  const auto& pool = supply_.pools[role];
  return std::find(pool.begin(), pool.end(), number) != pool.end();
}

glm::dvec2 Furnisher::beside(size_t number, glm::dvec2 local) const {
  const FurniturePlacement& placement = placements_[number];
  const glm::dvec2 t = sine_cosine(placement.angle);
  return {placement.position.x + t.y * local.x + t.x * local.y,
          placement.position.z - t.x * local.x + t.y * local.y};
}

bool Furnisher::put_on(size_t parent_number, size_t number, glm::dvec2 local, double turn) {
  const FurniturePlacement parent = placements_[parent_number];
  const FurniturePiece& base = piece(parent.piece);
  if (base.top <= 0) return false;
  const glm::dvec2 centre = beside(parent_number, local);
  const double angle = parent.angle + turn;
  if (!parent.footprint.contains(turned_footprint(piece(number).size, centre, angle))) return false;
  return add(number, centre, angle, parent.bottom + base.top, parent_number);
}

int Furnisher::scatter_on(size_t parent, FurnitureRole role, int count) {
  int put_count = 0;
  for (int i = 0; i < count; ++i) {
    const auto number = choose(role);
    if (!number) return put_count;
    const glm::dvec3 base = piece(placements_[parent].piece).size, size = piece(*number).size;
    for (int attempt = 0; attempt < 8; ++attempt) {
      const glm::dvec2 local((random_.uniform() - 0.5) * (base.x - size.x),
                             (random_.uniform() - 0.5) * (base.z - size.z));
      if (put_on(parent, *number, local, random_.between(-0.4, 0.4))) {
        ++put_count;
        break;
      }
    }
  }
  return put_count;
}

bool Furnisher::put_at_ceiling(size_t number, glm::dvec2 centre, double angle) {
  return put(number, centre, angle, ceiling - piece(number).size.y);
}

}  // namespace triptych
