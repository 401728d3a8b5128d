// The groups of furniture that rooms are made of: workplaces, rows of tables, kitchens, sitting corners.
#pragma once

#include "samples/building/furnisher.hpp"

#include <vector>

namespace triptych {

// Anywhere.
void put_at_walls(Furnisher& f, FurnitureRole role, int count);
void put_on_walls(Furnisher& f, FurnitureRole role, int count, double bottom);
void put_lights(Furnisher& f);
void put_under_windows(Furnisher& f, FurnitureRole role);
void put_in_windows(Furnisher& f);
/// Sockets, a light switch, a smoke detector.
void put_services(Furnisher& f, int sockets);
void put_person(Furnisher& f, int count);
/// Things on cabinets and shelves.
void put_on_tops(Furnisher& f);
/// One of each role on every table.
void put_on_tables(Furnisher& f, const std::vector<FurnitureRole>& roles);

// Where people work; each returns the numbers of the desks or tables that it placed.
std::vector<size_t> put_workplaces_at_walls(Furnisher& f, int count);
std::vector<size_t> put_desk_islands(Furnisher& f, bool along_x);
std::vector<size_t> put_class_rows(Furnisher& f, Side front, FurnitureRole table, FurnitureRole chair);
std::vector<size_t> put_conference_table(Furnisher& f);
void put_teacher(Furnisher& f, Side front);
/// A computer, a telephone and a lamp on each desk.
void equip_desks(Furnisher& f, const std::vector<size_t>& desks);
void clutter_desks(Furnisher& f, const std::vector<size_t>& desks, int count);
void put_shelf_rows(Furnisher& f);

// Where they do not.
std::vector<size_t> put_kitchen_run(Furnisher& f);
void put_dining_groups(Furnisher& f, int count);
void put_sitting_groups(Furnisher& f, int count);
void put_games(Furnisher& f);
/// A row along a wall; bottom < 0: at the height that the catalogue gives.
void put_row(Furnisher& f, FurnitureRole role, Side side, double pitch, double bottom, int count);
void put_on_basins(Furnisher& f);

}  // namespace triptych
