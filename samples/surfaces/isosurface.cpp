#include "samples/surfaces/isosurface.hpp"

#include "samples/orbits.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace triptych {
namespace {

const glm::dvec3 domain_low(0), domain_high(2, 1, 2);  // metres
constexpr double middle = 0.5;

/// A density that rises across the layer, pushed up and down by bubbles and spikes, and stirred by turbulence
/// that dies away above and below.
class MixingLayer : public Field {
 public:
  MixingLayer(uint64_t seed, double step) {
    const auto stream = static_cast<uint32_t>(seed * 64);
    bumps_ = {{2.6, 0.30, stream}, {5.3, 0.22, stream + 1}, {10.9, 0.10, stream + 2}};
    // Kolmogorov: fluctuations go with the cube root of their size; a steeper fall keeps the surface legible.
    constexpr double first = 4.3, ratio = 1.93, fall = 0.52;
    double frequency = first, amplitude = 2.5;
    for (uint32_t i = 3; i < 24; ++i, frequency *= ratio, amplitude *= std::pow(ratio, -fall)) {
      // An octave needs three and a half samples a wave, and fades in up to seven: no jump as the step
      // changes.
      const double samples = 1 / (frequency * step), shown = std::clamp(samples / 3.5 - 1, 0.0, 1.0);
      if (shown > 0) octaves_.push_back({frequency, amplitude * shown, stream + i});
    }
  }

  void evaluate(const SampleRow& row, std::span<float> values) const override {
    constexpr double calm = 0.42, slope = 3.6;
    const double away = std::abs(row.y - middle);
    const double stirred = 1 - glm::smoothstep(0.16, calm, away);
    const double rise = (row.y - middle) * slope;
    std::fill(values.begin(), values.end(), static_cast<float>(rise));
    if (away >= calm) return;  // no bump reaches that far
    // Bumps move the layer as a whole: the same at each height.
    for (const NoiseOctave& bump : bumps_) add_noise(bump, {row.x, 0.37, row.z, row.step}, values);
    if (stirred <= 0) return;
    for (const NoiseOctave& octave : octaves_)
      add_noise({octave.frequency, octave.amplitude * stirred, octave.seed}, row, values);
  }

 private:
  std::vector<NoiseOctave> bumps_, octaves_;
};

}  // namespace

std::unique_ptr<Field> mixing_layer(uint64_t seed, double step) {
  return std::make_unique<MixingLayer>(seed, step);
}

SurfaceReport make_isosurface(const SurfaceOptions& options, const std::filesystem::path& folder) {
  check_surface_options("sample isosurface", options);
  const auto field = [&](double step) { return mixing_layer(options.seed, step); };
  const SurfaceReport report =
      write_surface(field, domain_low, domain_high, options.triangles, folder, "triptych sample isosurface");
  // The eye circles close above the layer, dives along it, and stands in the middle of it.
  const glm::dvec3 centre(1, middle, 1);
  write_orbits({.centre = centre, .radius = 1.9, .closest = 0.75, .low = 0.72, .high = 1.5, .spin = centre},
               Random(options.seed), folder);
  return report;
}

}  // namespace triptych
