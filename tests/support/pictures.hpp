// Pictures held against each other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych::test {

/// How many pixels differ between two pictures of the same size, RGBA bytes.
inline size_t differing_pixels(const std::vector<uint8_t>& one, const std::vector<uint8_t>& other) {
  size_t count = 0;
  for (size_t i = 0; i < one.size(); i += 4) count += !std::equal(&one[i], &one[i] + 4, &other[i]);
  return count;
}

}  // namespace triptych::test
