// Where rays go: low-discrepancy points that depend on nothing but their numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace triptych {

/// Mixes all bits (the finaliser of splitmix64: Steele, Lea and Flood, Fast splittable pseudorandom number
/// generators, 2014).
inline uint64_t mixed_bits(uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// The points of one sequence, in the unit square: those of the R2 sequence (Roberts, The unreasonable
/// effectiveness of quasirandom sequences, 2018), moved as a whole by what `seed` says (Cranley and
/// Patterson, Randomization of number theoretic methods for multiple integration, 1976).
class SamplePoints {
 public:
  explicit SamplePoints(uint64_t seed) {
    const uint64_t bits = mixed_bits(seed + 0x9e3779b97f4a7c15u);
    first_ = static_cast<uint32_t>(bits);
    second_ = static_cast<uint32_t>(bits >> 32);
  }
  /// Both from 0 to below 1.
  glm::dvec2 operator[](uint32_t index) const {
    // 2³² over the powers of the root of x³ = x + 1: whole numbers wrap around as they should.
    constexpr uint32_t step_1 = 3242174889u, step_2 = 2447445414u;
    constexpr double scale = 1.0 / 4294967296.0;
    return {(first_ + (index + 1) * step_1) * scale, (second_ + (index + 1) * step_2) * scale};
  }

 private:
  uint32_t first_, second_;
};

/// Two unit vectors that make a right-handed frame with n, of unit length (Duff and others, Building an
/// orthonormal basis, revisited, 2017).
struct Frame3 {
  explicit Frame3(const glm::dvec3& n) : z(n) {
    const double sign = std::copysign(1.0, n.z), a = -1.0 / (sign + n.z), b = n.x * n.y * a;
    x = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    y = {b, sign + n.y * n.y * a, -n.y};
  }
  glm::dvec3 x, y, z;
};

/// A direction about z, as dense as its cosine with it; u: in the unit square (Malley's method).
inline glm::dvec3 cosine_direction(const Frame3& frame, const glm::dvec2& u) {
  const double r = std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
  return frame.x * (r * std::cos(angle)) + frame.y * (r * std::sin(angle)) +
         frame.z * std::sqrt(std::max(0.0, 1 - u.x));
}

}  // namespace triptych
