// Gradient noise (Perlin 2002, "Improving noise"), at points and, much cheaper, along rows.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

namespace triptych {

/// One octave: about -0.7 to 0.7 times the amplitude, with features of about 1 / frequency.
struct NoiseOctave {
  double frequency = 1, amplitude = 1;
  uint32_t seed = 0;
};

/// The octave's value at a point.
double noise_at(const NoiseOctave& octave, const glm::dvec3& point);

/// Samples in a row along x: at (x + i * step, y, z).
struct SampleRow {
  double x, y, z, step;
};

/// Adds the octave to each sample. What depends on y and z alone is worked out once for each lattice cell of
/// the noise that the row crosses.
void add_noise(const NoiseOctave& octave, const SampleRow& row, std::span<float> values);

}  // namespace triptych
