// A hash of small integer keys for geometry: indices, corners of triangles, points.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// Multiplies by the golden ratio and folds (Fibonacci hashing): neighbouring keys go to distant slots.
struct KeyHash {
  size_t operator()(uint64_t key) const { return finish(mix(0, key)); }
  template <size_t count>
  size_t operator()(const std::array<uint32_t, count>& key) const {
    uint64_t hash = 0;
    for (const uint32_t value : key) hash = mix(hash, value);
    return finish(hash);
  }
  size_t operator()(const glm::ivec3& point) const {
    return (*this)(std::array{static_cast<uint32_t>(point.x), static_cast<uint32_t>(point.y),
                              static_cast<uint32_t>(point.z)});
  }

 private:
  static uint64_t mix(uint64_t hash, uint64_t value) {
    return (hash ^ value ^ hash >> 29) * 0x9e3779b97f4a7c15u;
  }
  static size_t finish(uint64_t hash) { return hash ^ hash >> 32; }
};

/// Whether two such keys are equal, inline: the standard library calls a function to compare arrays.
struct KeyEqual {
  template <size_t count>
  bool operator()(const std::array<uint32_t, count>& a, const std::array<uint32_t, count>& b) const {
    uint32_t difference = 0;
    for (size_t i = 0; i < count; ++i) difference |= a[i] ^ b[i];
    return difference == 0;
  }
};

}  // namespace triptych
