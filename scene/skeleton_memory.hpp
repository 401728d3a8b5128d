// What a skeleton takes in memory, array by array.
#pragma once

#include "scene/skeleton.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace triptych {

struct ArrayMemory {
  std::string_view name;
  uint64_t count = 0, bytes = 0;  ///< bytes: with what is reserved
};

/// The arrays that grow with the model, those of every drawable first.
std::vector<ArrayMemory> skeleton_memory(const Skeleton& skeleton);

/// Of all of them.
uint64_t skeleton_bytes(const Skeleton& skeleton);

}  // namespace triptych
