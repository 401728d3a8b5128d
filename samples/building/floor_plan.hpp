// The plan of an office building in the manner of Soda Hall (Berkeley): two long corridors on every floor,
// joined by cross corridors and a hall with an opening through all floors; offices outside, classrooms and
// service rooms within.
#pragma once

#include "samples/random.hpp"
#include "samples/rect.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace triptych {

/// The measures that everything in the building shares; metres.
namespace measures {
inline constexpr double width = 60, depth = 40, storey = 3.6, slab = 0.3, ceiling = 2.9, ceiling_panel = 0.04;
inline constexpr double inner_wall = 0.15, outer_wall = 0.35;
inline constexpr double door_width = 0.95, door_height = 2.1, door_leaf = 0.04, door_frame = 0.03;
inline constexpr double stall_width = 1.0, stall_depth = 1.5, partition_height = 2.0;
inline constexpr double window_width = 1.4, window_sill = 0.9, window_top = 2.5;
}  // namespace measures

enum class RoomType {
  office,
  open_office,
  classroom,
  computer_room,
  meeting_room,
  kitchen,
  lavatory,
  lounge,
  library,
  store,
  copy_room,
  games_room,
  corridor,
  hall,
  stairs
};
const char* room_type_name(RoomType type);

enum class OpeningKind { door, window, passage };

/// A hole in a wall; `from` and `to` run along the wall, in building coordinates, `bottom` and `top` above
/// the floor.
struct Opening {
  OpeningKind kind = OpeningKind::passage;
  double from = 0, to = 0, bottom = 0, top = 0;
  bool leaf_to_high = false;  ///< doors: the open leaf stands in the room on the wall's high side
  bool hinge_at_to = false;   ///< doors: the leaf hangs at `to`, not at `from`
};

/// A straight wall between two rooms, or between a room and outside.
struct Wall {
  int floor = 0;
  bool along_x = false;
  Rect footprint;
  double bottom = 0, top = 0;         ///< above the floor
  int low_room = -1, high_room = -1;  ///< on the side of smaller and of larger coordinates; -1 is outside
  std::vector<Opening> openings;
};

struct Room {
  int floor = 0;
  RoomType type = RoomType::office;
  std::string name;              ///< "2.114"
  Rect grid;                     ///< to the middle of inner walls, to the inside of outer walls
  Rect area;                     ///< between the walls' faces
  std::vector<Rect> partitions;  ///< thin walls between the stalls of a lavatory
  std::vector<Rect> voids;       ///< where its floor is open to the storey below
};

struct FloorPlan {
  int floors = 0;
  std::vector<Room> rooms;
  std::vector<Wall> walls;
};

inline double floor_level(int floor) { return floor * measures::storey; }

/// An open door's leaf as it stands in the room.
Rect leaf_footprint(const Wall& wall, const Opening& door);

/// Where the hall's and the stairwells' floors are open (on every floor but the lowest).
Rect hall_void();
std::vector<Rect> stair_voids();

inline constexpr int max_floors = 100;

/// Error for fewer than 1 or more than max_floors.
FloorPlan make_floor_plan(int floors, const Random& random);

}  // namespace triptych
