#include "samples/building/furnish.hpp"
#include "samples/building/room_parts.hpp"

#include <algorithm>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

using namespace measures;

void furnish_office(Furnisher& f) {
  const int places = std::clamp(static_cast<int>(f.area().area() / 8.0), 1, 4);
  const auto desks = put_workplaces_at_walls(f, places);
  put_at_walls(f, FurnitureRole::bookcase, 1 + f.random().chance(0.6));
  put_lights(f);
  equip_desks(f, desks);
  put_at_walls(f, FurnitureRole::cabinet, 1);
  put_under_windows(f, FurnitureRole::radiator);
  put_at_walls(f, FurnitureRole::dustbin, 1);
  put_at_walls(f, FurnitureRole::floor_plant, 1);
  put_at_walls(f, FurnitureRole::chair, 2);
  if (f.random().chance(0.15)) put_person(f, 1);
  put_services(f, 4);
  put_in_windows(f);
  clutter_desks(f, desks, 5);
  put_on_tops(f);
  put_at_walls(f, FurnitureRole::safe_box, f.random().chance(0.1));
  put_at_walls(f, FurnitureRole::box, 1 + f.random().chance(0.4));
  put_on_walls(f, FurnitureRole::hanger, 1, 1.4);
}

void furnish_open_office(Furnisher& f) {
  const bool along_x = f.area().width() >= f.area().depth();
  auto desks = put_desk_islands(f, along_x);
  if (desks.empty()) desks = put_workplaces_at_walls(f, 6);
  put_lights(f);
  put_at_walls(f, FurnitureRole::bookcase, 3);
  equip_desks(f, desks);
  put_at_walls(f, FurnitureRole::cabinet, 4);
  put_under_windows(f, FurnitureRole::radiator);
  put_at_walls(f, FurnitureRole::floor_plant, 3);
  put_at_walls(f, FurnitureRole::dustbin, 3);
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_person(f, 2);
  put_services(f, 8);
  put_in_windows(f);
  clutter_desks(f, desks, 4);
  put_on_tops(f);
  put_on_walls(f, FurnitureRole::hanger, 2, 1.4);
  put_at_walls(f, FurnitureRole::box, 3);
}

void furnish_classroom(Furnisher& f, bool computers) {
  const Side front = f.random().chance(0.5) ? Side::west : Side::east;
  put_teacher(f, front);
  const auto tables = put_class_rows(f, front, computers ? FurnitureRole::desk : FurnitureRole::big_table,
                                     computers ? FurnitureRole::office_chair : FurnitureRole::chair);
  put_lights(f);
  if (computers) equip_desks(f, tables);
  put_at_walls(f, FurnitureRole::bookcase, 2);
  put_at_walls(f, FurnitureRole::cabinet, 2);
  put_at_walls(f, FurnitureRole::dustbin, 2);
  put_at_walls(f, FurnitureRole::floor_plant, 1);
  put_person(f, 2);
  put_services(f, 8);
  put_in_windows(f);
  for (const size_t table : tables) {
    f.scatter_on(table, FurnitureRole::desk_item, 2);
    f.scatter_on(table, FurnitureRole::book, 1);
    f.scatter_on(table, FurnitureRole::mug, f.random().chance(0.5));
  }
  put_on_tops(f);
  put_on_walls(f, FurnitureRole::hanger, 3, 1.4);
}

void furnish_meeting_room(Furnisher& f) {
  const auto tables = put_conference_table(f);
  put_lights(f);
  for (const Side side : f.shuffled_sides()) {
    const auto screen = f.choose(FurnitureRole::wall_screen);
    if (screen && !f.has_door(side) && f.put_somewhere_at_wall(*screen, side, 1.2)) break;
  }
  if (const auto projector = f.choose(FurnitureRole::projector))
    f.put_at_ceiling(*projector, f.area().centre(), 0);
  put_at_walls(f, FurnitureRole::cabinet, 2);
  put_under_windows(f, FurnitureRole::radiator);
  put_at_walls(f, FurnitureRole::floor_plant, 2);
  put_at_walls(f, FurnitureRole::chair, 2);
  put_at_walls(f, FurnitureRole::dustbin, 1);
  put_services(f, 5);
  put_in_windows(f);
  for (const size_t table : tables) {
    f.scatter_on(table, FurnitureRole::mug, 3);
    f.scatter_on(table, FurnitureRole::bottle, 2);
    f.scatter_on(table, FurnitureRole::desk_item, 2);
    f.scatter_on(table, FurnitureRole::phone, f.random().chance(0.4));
  }
  put_person(f, 1);
  put_on_tops(f);
}

void furnish_kitchen(Furnisher& f) {
  const auto counters = put_kitchen_run(f);
  put_dining_groups(f, 6);
  put_lights(f);
  for (size_t i = 0; i < counters.size(); ++i) {
    f.scatter_on(counters[i], FurnitureRole::appliance, 1);
    f.scatter_on(counters[i], FurnitureRole::food, 1);
    f.scatter_on(counters[i], FurnitureRole::bottle, 1);
  }
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_at_walls(f, FurnitureRole::dustbin, 2);
  put_at_walls(f, FurnitureRole::floor_plant, 1);
  put_at_walls(f, FurnitureRole::cleaning, 1);
  put_under_windows(f, FurnitureRole::radiator);
  put_person(f, 2);
  put_services(f, 5);
  put_in_windows(f);
  put_on_tables(f, {FurnitureRole::plate, FurnitureRole::mug, FurnitureRole::food, FurnitureRole::bottle});
  put_at_walls(f, FurnitureRole::stool, 3);
}

void furnish_lavatory(Furnisher& f) {
  Side door = Side::west;
  for (const Side side : {Side::north, Side::east, Side::south, Side::west})
    if (f.has_door(side)) door = side;
  put_row(f, FurnitureRole::toilet, opposite(door), stall_width, 0, 7);
  put_row(f, FurnitureRole::washbasin, f.random().chance(0.5) ? Side::north : Side::south, 0.95, -1, 4);
  put_lights(f);
  put_row(f, FurnitureRole::urinal, door, 0.75, -1, 3);
  put_on_walls(f, FurnitureRole::paper_dispenser, 3, 0.8);
  put_on_walls(f, FurnitureRole::towel, 2, 1.1);
  put_at_walls(f, FurnitureRole::dustbin, 2);
  put_at_walls(f, FurnitureRole::cleaning, 1);
  put_services(f, 2);
  put_on_basins(f);
}

void furnish_lounge(Furnisher& f) {
  put_sitting_groups(f, 3);
  put_lights(f);
  put_at_walls(f, FurnitureRole::bookcase, 2);
  put_at_walls(f, FurnitureRole::floor_plant, 3);
  put_at_walls(f, FurnitureRole::floor_lamp, 2);
  put_at_walls(f, FurnitureRole::cabinet, 2);
  put_under_windows(f, FurnitureRole::radiator);
  put_dining_groups(f, 2);
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_person(f, 2);
  put_services(f, 5);
  put_in_windows(f);
  put_on_tables(f, {FurnitureRole::mug, FurnitureRole::ornament, FurnitureRole::book});
  put_on_tops(f);
}

void furnish_library(Furnisher& f) {
  put_shelf_rows(f);
  put_lights(f);
  put_at_walls(f, FurnitureRole::bookcase, 8);
  put_dining_groups(f, 3);
  put_at_walls(f, FurnitureRole::armchair, 2);
  put_at_walls(f, FurnitureRole::floor_plant, 2);
  put_person(f, 2);
  put_services(f, 6);
  put_in_windows(f);
  put_on_tables(
      f, {FurnitureRole::book, FurnitureRole::book, FurnitureRole::desk_lamp, FurnitureRole::computer});
  put_on_tops(f);
}

void furnish_store(Furnisher& f) {
  put_at_walls(f, FurnitureRole::shelf, 4);
  put_at_walls(f, FurnitureRole::box, 6);
  put_lights(f);
  put_at_walls(f, FurnitureRole::ladder, 2);
  put_at_walls(f, FurnitureRole::cabinet, 2);
  put_at_walls(f, FurnitureRole::cleaning, 2);
  put_at_walls(f, FurnitureRole::safe_box, 2);
  put_services(f, 2);
  put_on_tops(f);
}

void furnish_copy_room(Furnisher& f) {
  const size_t first = f.placements().size();
  put_at_walls(f, FurnitureRole::desk, 3);
  std::vector<size_t> desks;
  for (size_t i = first; i < f.placements().size(); ++i) desks.push_back(i);
  for (const size_t desk : desks) f.scatter_on(desk, FurnitureRole::printer, 1);
  put_lights(f);
  put_at_walls(f, FurnitureRole::shelf, 2);
  put_at_walls(f, FurnitureRole::cabinet, 3);
  put_at_walls(f, FurnitureRole::dustbin, 3);
  put_at_walls(f, FurnitureRole::box, 3);
  put_services(f, 4);
  put_in_windows(f);
  for (const size_t desk : desks) f.scatter_on(desk, FurnitureRole::book, 3);
  put_on_tops(f);
}

void furnish_games_room(Furnisher& f) {
  put_games(f);
  put_lights(f);
  put_at_walls(f, FurnitureRole::sofa, 2);
  put_at_walls(f, FurnitureRole::exercise, 3);
  put_at_walls(f, FurnitureRole::armchair, 3);
  put_at_walls(f, FurnitureRole::stool, 3);
  put_at_walls(f, FurnitureRole::floor_plant, 2);
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_person(f, 3);
  put_services(f, 6);
  put_in_windows(f);
  put_on_tops(f);
}

void furnish_corridor(Furnisher& f) {
  // People walk in the middle.
  const Rect& area = f.area();
  const bool along_x = area.width() >= area.depth();
  constexpr double way = 1.45;
  const glm::dvec2 middle = area.centre();
  f.keep_free(along_x ? Rect{area.x0, middle.y - way / 2, area.x1, middle.y + way / 2}
                      : Rect{middle.x - way / 2, area.z0, middle.x + way / 2, area.z1},
              0, 2.3);
  const int length = static_cast<int>(std::max(area.width(), area.depth()) / 7);
  put_at_walls(f, FurnitureRole::bench, length);
  put_lights(f);
  put_at_walls(f, FurnitureRole::extinguisher, length / 2 + 1);
  put_at_walls(f, FurnitureRole::floor_plant, length);
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_on_walls(f, FurnitureRole::emergency_sign, 2, 2.3);
  put_on_walls(f, FurnitureRole::camera, 1, 2.4);
  put_at_walls(f, FurnitureRole::dustbin, length / 2 + 1);
  put_on_walls(f, FurnitureRole::wall_lamp, length, 1.8);
  put_at_walls(f, FurnitureRole::chair, length);
  put_services(f, 2 + 2 * length);
  put_on_walls(f, FurnitureRole::hanger, 1, 1.3);
}

void furnish_hall(Furnisher& f) {
  put_at_walls(f, FurnitureRole::bench, 4);
  put_at_walls(f, FurnitureRole::sofa, 2);
  put_lights(f);
  put_at_walls(f, FurnitureRole::floor_plant, 8);
  put_at_walls(f, FurnitureRole::armchair, 4);
  put_at_walls(f, FurnitureRole::water_cooler, 1);
  put_at_walls(f, FurnitureRole::extinguisher, 2);
  if (f.room().voids.empty()) put_sitting_groups(f, 2);
  put_on_walls(f, FurnitureRole::emergency_sign, 3, 2.3);
  put_on_walls(f, FurnitureRole::camera, 2, 2.4);
  put_person(f, 4);
  put_at_walls(f, FurnitureRole::dustbin, 3);
  put_on_walls(f, FurnitureRole::wall_lamp, 8, 1.8);
  put_services(f, 10);
  put_on_tables(f, {FurnitureRole::mug, FurnitureRole::ornament});
}

void furnish_stairs(Furnisher& f) {
  put_lights(f);
  put_at_walls(f, FurnitureRole::extinguisher, 1);
  put_on_walls(f, FurnitureRole::emergency_sign, 1, 2.4);
  put_at_walls(f, FurnitureRole::floor_plant, 1);
  put_services(f, 2);
}

}  // namespace

std::vector<FurniturePlacement> furnish_room(const Supply& supply, const FloorPlan& plan, int room,
                                             const Random& random) {
  Furnisher f(supply, plan, room, random);
  switch (f.room().type) {
    case RoomType::office:
      furnish_office(f);
      break;
    case RoomType::open_office:
      furnish_open_office(f);
      break;
    case RoomType::classroom:
      furnish_classroom(f, false);
      break;
    case RoomType::computer_room:
      furnish_classroom(f, true);
      break;
    case RoomType::meeting_room:
      furnish_meeting_room(f);
      break;
    case RoomType::kitchen:
      furnish_kitchen(f);
      break;
    case RoomType::lavatory:
      furnish_lavatory(f);
      break;
    case RoomType::lounge:
      furnish_lounge(f);
      break;
    case RoomType::library:
      furnish_library(f);
      break;
    case RoomType::store:
      furnish_store(f);
      break;
    case RoomType::copy_room:
      furnish_copy_room(f);
      break;
    case RoomType::games_room:
      furnish_games_room(f);
      break;
    case RoomType::corridor:
      furnish_corridor(f);
      break;
    case RoomType::hall:
      furnish_hall(f);
      break;
    case RoomType::stairs:
      furnish_stairs(f);
      break;
  }
  return f.placements();
}

}  // namespace triptych
