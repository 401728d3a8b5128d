// Connected components: sets of numbers that are joined two by two (union-find).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace triptych {

/// The numbers below `count`, each a set of its own at first. A set is named by its smallest member, its
/// root.
class DisjointSets {
 public:
  explicit DisjointSets(size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  uint32_t root(uint32_t member) {
    while (parents_[member] != member) member = parents_[member] = parents_[parents_[member]];
    return member;
  }

  void join(uint32_t a, uint32_t b) {
    const auto [kept, gone] = std::minmax({root(a), root(b)});
    parents_[gone] = kept;
  }

 private:
  std::vector<uint32_t> parents_;
};

}  // namespace triptych
