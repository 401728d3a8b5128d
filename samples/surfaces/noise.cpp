#include "samples/surfaces/noise.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {
namespace {

/// A gradient from a lattice point's bits: any direction, components of -1 to 1.
glm::dvec3 gradient(int64_t x, int64_t y, int64_t z, uint32_t seed) {
  uint32_t bits = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
                  static_cast<uint32_t>(z) * 0xcb1ab31fu ^ seed * 0x9e3779b9u;
  bits = (bits ^ (bits >> 15)) * 0x2c1b3c6du;
  bits = (bits ^ (bits >> 12)) * 0x297a2d39u;
  bits ^= bits >> 15;
  constexpr double half = 127.5;
  return glm::dvec3(bits & 255u, (bits >> 8) & 255u, (bits >> 16) & 255u) / half - 1.0;
}

double faded(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// The noise between y and z neighbours of one lattice plane x = i is linear in x.
struct Plane {
  double value, slope;
};

Plane plane_at(int64_t i, double y, double z, uint32_t seed) {
  const auto j = static_cast<int64_t>(std::floor(y)), k = static_cast<int64_t>(std::floor(z));
  const double dy = y - static_cast<double>(j), dz = z - static_cast<double>(k);
  const double wy = faded(dy), wz = faded(dz);
  Plane plane{0, 0};
  for (int b = 0; b < 2; ++b) {
    for (int c = 0; c < 2; ++c) {
      const glm::dvec3 g = gradient(i, j + b, k + c, seed);
      const double weight = (b ? wy : 1 - wy) * (c ? wz : 1 - wz);
      plane.value += weight * (g.y * (dy - b) + g.z * (dz - c));
      plane.slope += weight * g.x;
    }
  }
  return plane;
}

}  // namespace

double noise_at(const NoiseOctave& octave, const glm::dvec3& point) {
  const glm::dvec3 at = point * octave.frequency;
  const auto i = static_cast<int64_t>(std::floor(at.x));
  const double dx = at.x - static_cast<double>(i);
  const Plane left = plane_at(i, at.y, at.z, octave.seed), right = plane_at(i + 1, at.y, at.z, octave.seed);
  return octave.amplitude *
         glm::mix(left.value + left.slope * dx, right.value + right.slope * (dx - 1), faded(dx));
}

void add_noise(const NoiseOctave& octave, const SampleRow& row, std::span<float> values) {
  const double x = row.x * octave.frequency, y = row.y * octave.frequency, z = row.z * octave.frequency,
               step = row.step * octave.frequency;
  const auto amplitude = static_cast<float>(octave.amplitude);
  auto cell = static_cast<int64_t>(std::floor(x));
  Plane left{}, right = plane_at(cell, y, z, octave.seed);
  for (size_t i = 0; i < values.size(); ++cell) {
    left = right;
    right = plane_at(cell + 1, y, z, octave.seed);
    const auto end = static_cast<size_t>(
        std::clamp(std::ceil((static_cast<double>(cell + 1) - x) / step), 0.0, double(values.size())));
    const auto a = static_cast<float>(left.value), b = static_cast<float>(left.slope),
               c = static_cast<float>(right.value), d = static_cast<float>(right.slope);
    const auto from = static_cast<float>(x - static_cast<double>(cell)), by = static_cast<float>(step);
    for (; i < end; ++i) {
      const float t = from + static_cast<float>(static_cast<int>(i)) * by;
      const float low = a + b * t, high = c + d * (t - 1);
      values[i] += amplitude * (low + (high - low) * (t * t * t * (t * (t * 6 - 15) + 10)));
    }
  }
}

}  // namespace triptych
