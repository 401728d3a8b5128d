// Which points lie within the tolerance of contacts of a place.
#pragma once

#include "preprocess/contacts/find_contacts.hpp"
#include "simplify/key_hash.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <tsl/robin_map.h>
#include <utility>
#include <vector>

namespace triptych {

/// Some of a surface's points, by cells twice as wide as the tolerance; each cell's are a list.
class NearPoints {
 public:
  /// `of`: indices into the points; must outlive it.
  NearPoints(std::span<const glm::ivec3> points, std::span<const uint32_t> of)
      : of_(of), next_(of.size(), end) {
    for (uint32_t i = 0; i < of.size(); ++i) {
      const auto [cell, inserted] = first_.try_emplace(cell_of(points[of[i]]), i);
      if (!inserted) next_[i] = std::exchange(cell.value(), i);
    }
  }
  /// Calls visit(point) for all that are within the tolerance of a place, and some beyond it.
  template <typename Visit>
  void visit(const glm::ivec3& place, const Visit& visit) const {
    const glm::ivec3 lo = cell_of(place - reach), hi = cell_of(place + reach);
    for (int x = lo.x; x <= hi.x; ++x) {
      for (int y = lo.y; y <= hi.y; ++y) {
        for (int z = lo.z; z <= hi.z; ++z) {
          const auto found = first_.find({x, y, z});
          for (uint32_t i = found == first_.end() ? end : found->second; i != end; i = next_[i])
            visit(of_[i]);
        }
      }
    }
  }

 private:
  static constexpr int reach = 16, bits = 5;
  static_assert(reach >= contact_steps && 1 << bits == 2 * reach);
  static constexpr uint32_t end = 0xffffffffu;
  static glm::ivec3 cell_of(const glm::ivec3& place) {
    return {place.x >> bits, place.y >> bits, place.z >> bits};
  }

  std::span<const uint32_t> of_;
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> first_;  ///< into of_, of each cell
  std::vector<uint32_t> next_;
};

}  // namespace triptych
