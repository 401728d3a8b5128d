#include "samples/building/room_parts.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {

using namespace measures;

void put_at_walls(Furnisher& f, FurnitureRole role, int count) {
  for (int i = 0; i < count; ++i) {
    const auto piece = f.choose(role);
    if (piece) f.put_somewhere(*piece);
  }
}

void put_on_walls(Furnisher& f, FurnitureRole role, int count, double bottom) {
  for (int i = 0; i < count; ++i) {
    const auto piece = f.choose(role);
    if (piece) f.put_somewhere(*piece, std::min(bottom, ceiling - 0.05 - f.piece(*piece).size.y), 0.002);
  }
}

void put_lights(Furnisher& f) {
  const auto light = f.choose(FurnitureRole::ceiling_light);
  if (!light) return;
  constexpr double spacing = 2.7;
  const Rect& area = f.area();
  const int columns = std::max(1, static_cast<int>(std::lround(area.width() / spacing)));
  const int rows = std::max(1, static_cast<int>(std::lround(area.depth() / spacing)));
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      f.put_at_ceiling(
          *light,
          {area.x0 + area.width() * (column + 0.5) / columns, area.z0 + area.depth() * (row + 0.5) / rows},
          area.width() < area.depth() ? glm::half_pi<double>() : 0);
}

void put_under_windows(Furnisher& f, FurnitureRole role) {
  const auto piece = f.choose(role, [](const FurniturePiece& p) { return p.size.y < window_sill - 0.06; });
  if (!piece) return;
  for (const WindowPlace& window : f.windows()) f.put_at_wall(*piece, window.side, window.along, 0.05);
}

void put_in_windows(Furnisher& f) {
  const auto piece = f.choose(FurnitureRole::blind);
  if (!piece) return;
  for (const WindowPlace& window : f.windows()) f.put_in_window(*piece, window);
}

void put_services(Furnisher& f, int sockets) {
  if (const auto detector = f.choose(FurnitureRole::smoke_detector))
    f.put_at_ceiling(*detector, f.area().centre() + glm::dvec2(0.7, 0.4), 0);
  if (const auto light_switch = f.choose(FurnitureRole::light_switch)) {
    for (const Side side : f.shuffled_sides())
      if (f.has_door(side) && f.put_somewhere_at_wall(*light_switch, side, 1.15, 0.001)) break;
  }
  const auto socket = f.choose(FurnitureRole::socket);
  for (int i = 0; socket && i < sockets; ++i) f.put_somewhere(*socket, 0.25, 0.001);
}

void put_person(Furnisher& f, int count) {
  for (int i = 0; i < count; ++i) {
    const auto person = f.choose(FurnitureRole::person);
    if (!person) return;
    const Rect inside = f.area().grown(-0.4);
    for (int attempt = 0; attempt < 12; ++attempt) {
      const glm::dvec2 at(f.random().between(inside.x0, inside.x1), f.random().between(inside.z0, inside.z1));
      if (f.put(*person, at, f.random().between(0, glm::two_pi<double>()))) break;
    }
  }
}

void put_on_tops(Furnisher& f) {
  const size_t count = f.placements().size();
  for (size_t i = 0; i < count; ++i) {
    const FurniturePlacement placement = f.placements()[i];
    if (placement.bottom > 0.01 || placement.top > 1.7) continue;
    if (f.plays(placement.piece, FurnitureRole::cabinet) ||
        f.plays(placement.piece, FurnitureRole::bookcase) || f.plays(placement.piece, FurnitureRole::shelf)) {
      f.scatter_on(i, FurnitureRole::ornament, 1);
      f.scatter_on(i, FurnitureRole::small_plant, 1);
      f.scatter_on(i, FurnitureRole::book, 2);
      f.scatter_on(i, FurnitureRole::device, f.random().chance(0.3));
    }
  }
}

void put_on_tables(Furnisher& f, const std::vector<FurnitureRole>& roles) {
  const size_t count = f.placements().size();
  for (size_t i = 0; i < count; ++i) {
    const FurniturePlacement placement = f.placements()[i];
    if (!f.plays(placement.piece, FurnitureRole::small_table) &&
        !f.plays(placement.piece, FurnitureRole::coffee_table) &&
        !f.plays(placement.piece, FurnitureRole::big_table))
      continue;
    for (const FurnitureRole role : roles) f.scatter_on(i, role, 1);
  }
}

void put_shelf_rows(Furnisher& f) {
  const auto shelf =
      f.choose(FurnitureRole::bookcase, [](const FurniturePiece& p) { return p.size.x > 0.7; });
  if (!shelf) return;
  const glm::dvec3 size = f.piece(*shelf).size;
  const Rect inside = f.area().grown(-1.3);
  constexpr double aisle = 1.2;
  // Half of the room: people read in the other half.
  for (double x = inside.x0; x + 2 * size.z < inside.centre().x + 1; x += 2 * size.z + 0.04 + aisle) {
    for (double z = inside.z0 + size.x / 2; z + size.x / 2 < inside.z1; z += size.x + 0.01) {
      f.put(*shelf, {x + size.z / 2, z}, -glm::half_pi<double>());
      f.put(*shelf, {x + size.z * 1.5 + 0.04, z}, glm::half_pi<double>());
    }
  }
}

std::vector<size_t> put_kitchen_run(Furnisher& f) {
  std::vector<size_t> counters;
  const auto base = f.choose(FurnitureRole::kitchen_base), upper = f.choose(FurnitureRole::kitchen_upper);
  const std::vector<std::optional<size_t>> run{f.choose(FurnitureRole::fridge),
                                               base,
                                               f.choose(FurnitureRole::kitchen_sink),
                                               base,
                                               f.choose(FurnitureRole::kitchen_stove),
                                               base,
                                               f.choose(FurnitureRole::kitchen_stove),
                                               base,
                                               base,
                                               f.choose(FurnitureRole::fridge)};
  auto sides = f.shuffled_sides();
  std::stable_sort(sides.begin(), sides.end(), [&](Side a, Side b) { return f.has_door(a) < f.has_door(b); });
  const Side side = sides[0];
  const glm::dvec2 span = f.wall_span(side);
  double at = span.x + 0.03;
  for (const auto& piece : run) {
    if (!piece) continue;
    const double broad = f.piece(*piece).size.x;
    while (at + broad < span.y && !f.put_at_wall(*piece, side, at + broad / 2)) at += 0.15;
    if (at + broad >= span.y) break;
    if (f.piece(*piece).size.y < 1.0) counters.push_back(f.last());
    at += broad + 0.005;
  }
  if (!upper) return counters;
  const double broad = f.piece(*upper).size.x, bottom = f.piece(*upper).elevation;
  for (double along = span.x + 0.03 + broad / 2; along + broad / 2 < span.y; along += broad + 0.005)
    f.put_at_wall(*upper, side, along, bottom);
  return counters;
}

void put_games(Furnisher& f) {
  for (int i = 0; i < 3; ++i) {
    const auto game = f.choose(FurnitureRole::game);
    if (!game) return;
    const glm::dvec3 size = f.piece(*game).size;
    const Rect inside = f.area().grown(-0.9 - std::max(size.x, size.z) / 2);
    for (int attempt = 0; attempt < 30; ++attempt) {
      const glm::dvec2 at(f.random().between(inside.x0, inside.x1), f.random().between(inside.z0, inside.z1));
      if (f.put(*game, at, f.random().chance(0.5) ? 0 : glm::half_pi<double>())) break;
    }
  }
}

void put_row(Furnisher& f, FurnitureRole role, Side side, double pitch, double bottom, int count) {
  const auto piece = f.choose(role);
  if (!piece) return;
  const glm::dvec2 span = f.wall_span(side);
  const double height = bottom < 0 ? f.piece(*piece).elevation : bottom;
  double along = span.x + 0.5;
  for (int put = 0; put < count && along < span.y - 0.4;) {
    const bool fitted = f.put_at_wall(*piece, side, along, height);
    put += fitted;
    along += fitted ? pitch : 0.2;
  }
}

void put_on_basins(Furnisher& f) {
  const size_t count = f.placements().size();
  for (size_t i = 0; i < count; ++i)
    if (f.plays(f.placements()[i].piece, FurnitureRole::washbasin)) f.scatter_on(i, FurnitureRole::soap, 2);
}

}  // namespace triptych
