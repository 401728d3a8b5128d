// Puts furniture into one room: without overlaps, clear of doors, windows and openings in the floor.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/furniture_roles.hpp"

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace triptych {

/// One piece in its place. `angle` (radians) turns its front, local +z, towards (sin, cos) in plan.
struct FurniturePlacement {
  size_t piece = 0;
  glm::dvec3 position{0};  ///< middle of its underside, building coordinates
  double angle = 0;
  int room = 0;
  Rect footprint;              ///< axis-parallel box around it
  double bottom = 0, top = 0;  ///< above the room's floor
};

glm::dmat4 placement_transform(const FurniturePlacement& placement);

/// What rooms are furnished with.
struct Supply {
  const Furniture& furniture;
  const RolePools& pools;
  const std::vector<uint64_t>& triangles;  ///< of each piece
  /// Models are drawn with weight exp(-thrift * triangles / 4000): larger means lighter models.
  double thrift = 0;
};

enum class Side { north, east, south, west };
/// The angle of something that stands with its back to that wall of the room.
double facing_from(Side side);
Side opposite(Side side);

/// A box that must stay free: in front of a door or a window, or above a hole in the floor.
struct KeptFree {
  Rect area;
  double bottom = 0, top = 0;
};

struct WindowPlace {
  Side side = Side::north;
  double along = 0;
  Rect air;
};

class Furnisher {
 public:
  Furnisher(const Supply& supply, const FloorPlan& plan, int room, Random random);

  const Room& room() const { return plan_.rooms[static_cast<size_t>(room_)]; }
  const Rect& area() const { return room().area; }
  Random& random() { return random_; }
  const FurniturePiece& piece(size_t number) const { return supply_.furniture.pieces[number]; }
  const std::vector<FurniturePlacement>& placements() const { return placements_; }

  /// A model for the role, or nullopt if the catalogues have none that passes.
  std::optional<size_t> choose(FurnitureRole role,
                               const std::function<bool(const FurniturePiece&)>& passes = nullptr);

  void keep_free(const Rect& area, double bottom, double top) { kept_free_.push_back({area, bottom, top}); }

  /// Each puts the piece at the given place and returns whether it fitted; nothing changes if it did not.
  bool put(size_t piece, glm::dvec2 centre, double angle, double bottom = 0);
  bool put_at_wall(size_t piece, Side side, double along, double bottom = 0, double gap = 0.02);
  bool put_on(size_t parent, size_t piece, glm::dvec2 local, double turn = 0);
  bool put_at_ceiling(size_t piece, glm::dvec2 centre, double angle);

  /// The first place along the wall that has room, from a random start.
  bool put_somewhere_at_wall(size_t piece, Side side, double bottom = 0, double gap = 0.02);
  /// The same over the walls in random order.
  bool put_somewhere(size_t piece, double bottom = 0, double gap = 0.02);
  /// Before a window, from its top down.
  bool put_in_window(size_t piece, const WindowPlace& window);
  /// Up to `count` pieces of the role at random places on top of a placement. Returns how many fitted.
  int scatter_on(size_t parent, FurnitureRole role, int count);

  bool plays(size_t piece, FurnitureRole role) const;
  /// A point given in a placement's own axes.
  glm::dvec2 beside(size_t placement, glm::dvec2 local) const;
  const std::vector<WindowPlace>& windows() const { return windows_; }
  size_t last() const { return placements_.size() - 1; }
  void take_back(size_t count) { placements_.resize(placements_.size() - count); }
  /// Along the wall's run: x for north and south, z for east and west.
  glm::dvec2 wall_span(Side side) const;
  std::vector<Side> shuffled_sides();
  bool has_door(Side side) const;

 private:
  bool is_free(const Rect& footprint, double bottom, double top, size_t except) const;
  bool add(size_t piece, glm::dvec2 centre, double angle, double bottom, size_t except);
  void keep_openings_free();

  const Supply& supply_;
  const FloorPlan& plan_;
  int room_;
  Random random_;
  std::vector<KeptFree> kept_free_;
  std::vector<WindowPlace> windows_;
  bool before_windows_ = false;
  std::vector<FurniturePlacement> placements_;
  std::array<bool, 4> doors_{};
};

}  // namespace triptych
