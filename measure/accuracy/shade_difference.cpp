#include "measure/accuracy/shade_difference.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace triptych {

namespace {

/// Shades of neighbours that differ by no more than this, of 255, are of one smooth surface.
constexpr int smooth = 4;

int difference(std::span<const uint8_t> one, size_t a, std::span<const uint8_t> other, size_t b) {
  int largest = 0;
  for (size_t channel = 0; channel < 3; ++channel)
    largest = std::max(largest, std::abs(int{one[4 * a + channel]} - int{other[4 * b + channel]}));
  return largest;
}

}  // namespace

void ShadeDifferences::add(const ShadeDifferences& other) {
  for (size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

uint64_t ShadeDifferences::pixels() const {
  return std::accumulate(counts_.begin(), counts_.end(), uint64_t{0});
}

double ShadeDifferences::mean() const {
  double sum = 0;
  for (size_t i = 0; i < counts_.size(); ++i) sum += static_cast<double>(i) * static_cast<double>(counts_[i]);
  return sum / std::max(static_cast<double>(pixels()), 1.0);
}

int ShadeDifferences::p99() const {
  const uint64_t may_exceed = pixels() / 100;
  uint64_t beyond = 0;
  for (int i = 255; i > 0; --i) {
    beyond += counts_[static_cast<size_t>(i)];
    if (beyond > may_exceed) return i;
  }
  return 0;
}

ShadeDifferences shade_differences(std::span<const SurfacePixel> reference,
                                   std::span<const uint8_t> reference_colors,
                                   std::span<const SurfacePixel> shown, std::span<const uint8_t> shown_colors,
                                   int width, int height) {
  ShadeDifferences differences;
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  const auto alike = [&](const SurfacePixel& one, const SurfacePixel& other) {
    return !one.background() && one.found && other.found && one.color == other.color;
  };
  for (size_t y = 1; y + 1 < h; ++y) {
    for (size_t x = 1; x + 1 < w; ++x) {
      const size_t at = y * w + x;
      if (!alike(shown[at], reference[at])) continue;
      const std::array<size_t, 4> around = {at - 1, at + 1, at - w, at + w};
      const bool inside = std::ranges::all_of(around, [&](size_t next) {
        return alike(reference[next], reference[at]) &&
               difference(reference_colors, next, reference_colors, at) <= smooth;
      });
      if (inside) differences.add(static_cast<uint8_t>(difference(reference_colors, at, shown_colors, at)));
    }
  }
  return differences;
}

}  // namespace triptych
