// Where a person can stand on one floor, on a grid, and the ways between such places.
#pragma once

#include "samples/rect.hpp"

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace triptych {

class FreeSpace {
 public:
  static constexpr double cell = 0.05;

  /// Free is what is inside the area and at least `clearance` metres from every obstacle.
  FreeSpace(const Rect& area, const std::vector<Rect>& obstacles, double clearance);

  bool is_free(glm::dvec2 at) const;

  /// The place in the room farthest from everything, or nothing if none is free.
  bool widest_place(const Rect& room, glm::dvec2& place) const;

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
  glm::dvec2 corner_;  // of the area, where x and z are least
  int columns_, rows_;
  std::vector<float> distance_;  // to what is not free, in cells; 0: not free
};

}  // namespace triptych
