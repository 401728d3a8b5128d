#include "preprocess/contacts/small_contacts.hpp"

#include "base/disjoint_sets.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <cmath>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

/// The cells of a grid that hold locked points, as groups of neighbours.
class OccupiedCells {
 public:
  explicit OccupiedCells(double size) : size_(size) {}

  uint32_t add(const glm::ivec3& point) {
    const glm::ivec3 cell(glm::floor(glm::dvec3(point) / size_));
    const auto [found, added] = numbers_.try_emplace(cell, static_cast<uint32_t>(cells_.size()));
    if (added) cells_.push_back(cell);
    return found->second;
  }
  /// Cells that share a corner are in one group.
  DisjointSets groups() const {
    DisjointSets groups(cells_.size());
    for (uint32_t i = 0; i < cells_.size(); ++i) {
      for (int k = 0; k < 27; ++k) {
        const auto found = numbers_.find(cells_[i] + glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
        if (found != numbers_.end()) groups.join(i, found->second);
      }
    }
    return groups;
  }
  size_t count() const { return cells_.size(); }

 private:
  double size_;
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> numbers_;
  std::vector<glm::ivec3> cells_;
};

struct CellGroup {
  LatticeBox box;
  double reach = 0;  ///< the largest of its points
};

}  // namespace

void free_small_contacts(const Baked& baked, double distance, std::vector<uint8_t>& locked) {
  if (!(distance >= 1)) return;
  OccupiedCells cells(distance);
  std::vector<uint32_t> cell_of(locked.size());
  for (size_t i = 0; i < locked.size(); ++i) {
    if (locked[i]) cell_of[i] = cells.add(baked.surface.points[i]);
  }
  DisjointSets sets = cells.groups();
  std::vector<CellGroup> groups(cells.count());
  for (size_t i = 0; i < locked.size(); ++i) {
    if (!locked[i]) continue;
    CellGroup& group = groups[sets.root(cell_of[i])];
    group.box.extend(baked.surface.points[i]);
    group.reach = std::max(group.reach, static_cast<double>(baked.spans[i].reach));
  }
  for (size_t i = 0; i < locked.size(); ++i) {
    if (!locked[i]) continue;
    const CellGroup& group = groups[sets.root(cell_of[i])];
    const double extent = glm::length(glm::dvec3(group.box.hi) - glm::dvec3(group.box.lo));
    if (std::max(extent, group.reach) <= 2 * distance) locked[i] = 0;
  }
}

}  // namespace triptych
