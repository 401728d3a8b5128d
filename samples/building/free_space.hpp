// Where a person can stand on one floor, on a grid, and the ways between such places.
#pragma once

#include "samples/building/floor_plan.hpp"
#include "samples/building/furnisher.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// What a person of 1.8 metres cannot walk through on that floor: walls but for doors and passages, open door
/// leaves, openings in the floor, stairs, and furniture that stands or hangs in the way.
std::vector<Rect> obstacles(const FloorPlan& plan, const std::vector<FurniturePlacement>& placements,
                            int floor);

class FreeSpace {
 public:
  static constexpr double cell = 0.05;

  /// Free is what is at least `clearance` metres from every obstacle.
  FreeSpace(const std::vector<Rect>& obstacles, double clearance);

  bool is_free(glm::dvec2 at) const;

  /// The place in the room farthest from everything, or nothing if none is free.
  bool widest_place(const Room& room, glm::dvec2& place) const;

  /// Lengths of the shortest ways from a place, up to `reach` metres and not over `avoided`; infinite where
  /// there is none.
  struct Ways {
    std::vector<float> length;
    std::vector<int32_t> previous;
  };
  Ways ways_from(glm::dvec2 start, double reach, const Rect& avoided = {}) const;
  double length_to(const Ways& ways, glm::dvec2 end) const;
  /// The cells' centres from the start to `end`, which must have a way.
  std::vector<glm::dvec2> way_to(const Ways& ways, glm::dvec2 end) const;

 private:
  int index(glm::dvec2 at) const;  // -1 outside
  glm::dvec2 centre(int index) const;
  std::vector<float> distance_;  // to what is not free, in cells; 0: not free
};

}  // namespace triptych
