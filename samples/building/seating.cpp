// Groups with seats: desks and tables with their chairs, sofas with their tables.
#include "samples/building/room_parts.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

constexpr double pi = glm::pi<double>();

enum class Edge { front, right, back, left };

/// A seat at an edge of a desk or table, facing it; `along` runs from the middle of that edge.
bool put_seat(Furnisher& f, size_t table, size_t chair, double along, Edge edge = Edge::front) {
  const glm::dvec3 size = f.piece(f.placements()[table].piece).size;
  const bool across = edge == Edge::right || edge == Edge::left;
  const double away = ((across ? size.x : size.z) + f.piece(chair).size.z) / 2 + 0.05;
  glm::dvec2 local(0, away);
  double turn = pi;
  switch (edge) {
    case Edge::front:
      local = {along, away};
      break;
    case Edge::back:
      local = {along, -away}, turn = 0;
      break;
    case Edge::right:
      local = {away, along}, turn = -pi / 2;
      break;
    case Edge::left:
      local = {-away, along}, turn = pi / 2;
      break;
  }
  const glm::dvec2 at = f.beside(table, local);
  const double angle = f.placements()[table].angle + turn;
  return f.put(chair, at, angle + f.random().between(-0.2, 0.2)) || f.put(chair, at, angle);
}

/// A desk or table with a chair for every 0.9 metres; nothing if not even one chair has room.
bool put_workplace(Furnisher& f, size_t table, size_t chair, glm::dvec2 centre, double angle) {
  if (!f.put(table, centre, angle)) return false;
  const size_t number = f.last();
  const double width = f.piece(table).size.x;
  const int seats = std::max(1, static_cast<int>(width / 0.9));
  int put = 0;
  for (int i = 0; i < seats; ++i) put += put_seat(f, number, chair, width * ((i + 0.5) / seats - 0.5));
  if (put == 0) f.take_back(1);
  return put > 0;
}

bool put_chairs_around(Furnisher& f, size_t table, size_t chair, bool ends) {
  const glm::dvec3 size = f.piece(f.placements()[table].piece).size;
  int put = 0;
  for (const Edge edge : {Edge::front, Edge::right, Edge::back, Edge::left}) {
    const bool end = edge == Edge::right || edge == Edge::left;
    if (end && !ends) continue;
    const double length = end ? size.z : size.x;
    const int seats = std::max(1, static_cast<int>(length / 0.68));
    for (int i = 0; i < seats; ++i)
      put += put_seat(f, table, chair, length * ((i + 0.5) / seats - 0.5), edge);
  }
  return put > 0;
}

}  // namespace

std::vector<size_t> put_workplaces_at_walls(Furnisher& f, int count) {
  std::vector<size_t> desks;
  const auto desk = f.choose(FurnitureRole::desk), chair = f.choose(FurnitureRole::office_chair);
  if (!desk || !chair) return desks;
  for (int i = 0; i < count; ++i) {
    bool done = false;
    for (int attempt = 0; attempt < 4 && !done; ++attempt) {
      for (const Side side : f.shuffled_sides()) {
        if (!f.put_somewhere_at_wall(*desk, side)) continue;
        const size_t number = f.last();
        if (put_seat(f, number, *chair, 0)) {
          desks.push_back(number);
          done = true;
          break;
        }
        f.take_back(1);
      }
    }
  }
  return desks;
}

std::vector<size_t> put_desk_islands(Furnisher& f, bool along_x) {
  std::vector<size_t> desks;
  const auto desk = f.choose(FurnitureRole::desk), chair = f.choose(FurnitureRole::office_chair);
  if (!desk || !chair) return desks;
  const glm::dvec3 size = f.piece(*desk).size;
  const double seat = f.piece(*chair).size.z + 0.1, aisle = 0.75;
  const double pitch = 2 * size.z + 2 * seat + aisle;
  const Rect& area = f.area();
  const double across = along_x ? area.depth() : area.width(), along = along_x ? area.width() : area.depth();
  const int rows = std::max(1, static_cast<int>((across - aisle) / pitch));
  const int columns = std::max(1, static_cast<int>((along - 2 * aisle - 0.3) / (size.x + 0.04)));
  for (int row = 0; row < rows; ++row) {
    const double middle = across * (row + 0.5) / rows;
    for (int column = 0; column < columns; ++column) {
      if (columns > 5 && column % 4 == 3) continue;  // a way between islands
      const double at = (along - columns * (size.x + 0.04)) / 2 + (column + 0.5) * (size.x + 0.04);
      for (const int sign : {-1, 1}) {
        const double off = middle + sign * (size.z / 2 + 0.02);
        const glm::dvec2 centre =
            along_x ? glm::dvec2(area.x0 + at, area.z0 + off) : glm::dvec2(area.x0 + off, area.z0 + at);
        const double angle = along_x ? (sign > 0 ? 0 : pi) : sign * pi / 2;
        const size_t next = f.placements().size();
        if (put_workplace(f, *desk, *chair, centre, angle)) desks.push_back(next);
      }
    }
  }
  return desks;
}

std::vector<size_t> put_class_rows(Furnisher& f, Side front, FurnitureRole table_role,
                                   FurnitureRole chair_role) {
  std::vector<size_t> tables;
  const auto table =
      f.choose(table_role, [](const FurniturePiece& p) { return p.size.x < 1.95 && p.size.z < 0.97; });
  const auto chair = f.choose(chair_role);
  if (!table || !chair) return tables;
  const glm::dvec3 size = f.piece(*table).size;
  const Rect& area = f.area();
  const double pitch = size.z + f.piece(*chair).size.z + 0.45, aisle = 0.85;
  const double angle = facing_from(front), sign = front == Side::west ? 1 : -1;
  const double wall = front == Side::west ? area.x0 : area.x1;
  for (double away = 2.6; away + pitch / 2 < area.width() - 0.7; away += pitch) {
    double z = area.z0 + 0.6;
    for (int i = 0; z + size.x < area.z1 - 0.5; ++i) {
      const size_t next = f.placements().size();
      if (put_workplace(f, *table, *chair, {wall + sign * away, z + size.x / 2}, angle))
        tables.push_back(next);
      z += size.x + (i % 2 == 1 ? aisle : 0.02);
    }
  }
  return tables;
}

void put_teacher(Furnisher& f, Side front) {
  const glm::dvec2 span = f.wall_span(front);
  const double middle = (span.x + span.y) / 2;
  if (const auto board = f.choose(FurnitureRole::whiteboard)) {
    f.put_at_wall(*board, front, middle - 0.9);
    f.put_at_wall(*board, front, middle + 0.9);
  }
  if (const auto screen = f.choose(FurnitureRole::wall_screen))
    f.put_at_wall(*screen, front, middle - 2.6, 1.2, 0.002);
  if (const auto projector = f.choose(FurnitureRole::projector))
    f.put_at_ceiling(*projector, f.area().centre(), facing_from(opposite(front)));
  const auto desk = f.choose(FurnitureRole::desk), chair = f.choose(FurnitureRole::office_chair);
  if (!desk || !chair) return;
  const double sign = front == Side::west ? 1 : -1, wall = front == Side::west ? f.area().x0 : f.area().x1;
  put_workplace(f, *desk, *chair, {wall + sign * 1.75, middle + 1.9}, facing_from(opposite(front)));
}

std::vector<size_t> put_conference_table(Furnisher& f) {
  std::vector<size_t> tables;
  const auto table = f.choose(FurnitureRole::big_table), chair = f.choose(FurnitureRole::chair);
  if (!table || !chair) return tables;
  const Rect& area = f.area();
  const bool along_x = area.width() >= area.depth();
  const double length = along_x ? area.width() : area.depth(), width = f.piece(*table).size.x + 0.01;
  const int count = std::clamp(static_cast<int>((length - 2.8) / width), 1, 4);
  for (int i = 0; i < count; ++i) {
    const double off = width * (i + 0.5 - count / 2.0);
    const glm::dvec2 centre = area.centre() + (along_x ? glm::dvec2(off, 0) : glm::dvec2(0, off));
    if (f.put(*table, centre, along_x ? 0 : pi / 2)) tables.push_back(f.last());
  }
  for (const size_t number : tables) put_chairs_around(f, number, *chair, false);
  return tables;
}

void equip_desks(Furnisher& f, const std::vector<size_t>& desks) {
  const auto computer = f.choose(FurnitureRole::computer), lamp = f.choose(FurnitureRole::desk_lamp),
             phone = f.choose(FurnitureRole::phone);
  for (const size_t desk : desks) {
    const glm::dvec3 size = f.piece(f.placements()[desk].piece).size;
    const auto at_back = [&](const std::optional<size_t>& piece, double x) {
      if (piece) f.put_on(desk, *piece, {x, -size.z / 2 + f.piece(*piece).size.z / 2 + 0.06});
    };
    at_back(computer, 0);
    at_back(phone, size.x / 2 - 0.18);
    at_back(lamp, -size.x / 2 + 0.22);
  }
}

void clutter_desks(Furnisher& f, const std::vector<size_t>& desks, int count) {
  for (const size_t desk : desks) {
    f.scatter_on(desk, FurnitureRole::desk_item, count - 3);
    f.scatter_on(desk, FurnitureRole::mug, 1);
    f.scatter_on(desk, FurnitureRole::book, 1);
    f.scatter_on(desk, FurnitureRole::small_plant, f.random().chance(0.3));
    f.scatter_on(desk, FurnitureRole::desk_item, 1);
  }
}

void put_dining_groups(Furnisher& f, int count) {
  const auto table = f.choose(FurnitureRole::small_table), chair = f.choose(FurnitureRole::chair);
  if (!table || !chair) return;
  const Rect inside = f.area().grown(-1.3);
  for (int i = 0; i < count; ++i) {
    for (int attempt = 0; attempt < 12; ++attempt) {
      const glm::dvec2 at(f.random().between(inside.x0, inside.x1), f.random().between(inside.z0, inside.z1));
      if (!f.put(*table, at, f.random().chance(0.5) ? 0 : pi / 2)) continue;
      if (put_chairs_around(f, f.last(), *chair, true)) break;
      f.take_back(1);
    }
  }
}

void put_sitting_groups(Furnisher& f, int count) {
  for (int i = 0; i < count; ++i) {
    const auto sofa = f.choose(FurnitureRole::sofa), armchair = f.choose(FurnitureRole::armchair),
               table = f.choose(FurnitureRole::coffee_table), rug = f.choose(FurnitureRole::rug);
    if (!sofa || !f.put_somewhere(*sofa)) continue;
    const size_t seat = f.last();
    const double sofa_depth = f.piece(*sofa).size.z, sofa_angle = f.placements()[seat].angle;
    double reach = sofa_depth / 2;
    bool on_rug = false;
    if (rug) {
      const double depth = f.piece(*rug).size.z;
      on_rug = f.put(*rug, f.beside(seat, {0, reach + 0.05 + depth / 2}), sofa_angle);
    }
    if (table) {
      const double depth = f.piece(*table).size.z;
      if (!(on_rug && f.put_on(f.last(), *table, {0, 0})))
        f.put(*table, f.beside(seat, {0, reach + 0.4 + depth / 2}), sofa_angle);
      reach += 0.4 + depth;
    }
    if (!armchair) continue;
    const glm::dvec3 size = f.piece(*armchair).size;
    f.put(*armchair, f.beside(seat, {-0.6, reach + 0.4 + size.z / 2}), sofa_angle + pi);
    f.put(*armchair, f.beside(seat, {0.6, reach + 0.4 + size.z / 2}), sofa_angle + pi);
  }
}

}  // namespace triptych
