// The plan of a hospital: on every storey two long corridors with rooms on both sides, joined by a cross
// corridor; shafts and stairs stand above each other, everything else differs.
#pragma once

#include "samples/random.hpp"
#include "samples/rect.hpp"

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

namespace triptych {

/// The measures that everything in the hospital shares; metres, heights above the floor.
namespace hospital {
inline constexpr double width = 46.4, depth = 38, storey = 4.5, slab = 0.3, slab_underside = storey - slab;
inline constexpr double ceiling = 2.7, partition_top = 2.95, partition = 0.12, facade = 0.3, corridor = 2.4;
inline constexpr double door_width = 1.2, door_height = 2.15, door_jamb = 0.06;
inline constexpr double window_width = 1.3, window_sill = 0.9, window_top = 2.4;
/// The middles of the two long corridors.
inline constexpr double corridor_z[2] = {9.2, 28.8};
/// West and east of the cross corridor.
inline constexpr double blocks[2][2] = {{0, 22}, {24.4, 46.4}};
/// From its block's western end.
inline constexpr double shaft_width = 2.6;
}  // namespace hospital

enum class RoomUse {
  ward,
  office,
  treatment,
  laboratory,
  store,
  lavatory,
  lounge,
  plant_room,
  shaft,
  stairs
};
const char* room_use_name(RoomUse use);

struct HospitalRoom {
  int storey = 0;
  RoomUse use = RoomUse::ward;
  std::string name;           ///< "2.114"
  Rect grid;                  ///< to the middle of inner walls, to the inside of outer ones
  int corridor = 0;           ///< which of the two long ones it opens to
  double corridor_wall = 0;   ///< z of the middle of the wall between
  double inward = 1;          ///< 1: z grows away from the corridor; -1: it falls
  double door = 0;            ///< x of the middle of its door, or of its open front
  bool open_front = false;    ///< no door but a wide opening
  bool outer = false;         ///< has windows
  bool ceiling = true;        ///< a suspended one; without it the services are seen from below
  bool door_to_next = false;  ///< also opens to the room in the east

  /// Between the walls' faces.
  Rect area() const { return grid.grown(-hospital::partition / 2); }
  /// At x, at a height, and so far from the corridor's wall into the room; in the corridor if below 0.
  glm::dvec3 at(double x, double y, double t) const { return {x, y, corridor_wall + inward * t}; }
  glm::dvec3 into() const { return {0, 0, inward}; }
  /// From the corridor's wall to the one opposite, from face to face.
  double depth() const { return area().depth(); }
  /// A door's middle in the wall to the next room, from the corridor's wall.
  double next_door_at() const { return depth() - 1.4; }
};

/// Whether ceilings are there: on every second storey in the western half only, on the others nowhere.
inline bool has_ceiling(int storey, double x) { return storey % 2 == 0 && x < hospital::width / 2; }

/// The floor's height.
inline double hospital_level(int storey) { return storey * hospital::storey; }

std::vector<HospitalRoom> plan_storey(int storey, Random random);

}  // namespace triptych
