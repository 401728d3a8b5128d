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

bool alike(const SurfacePixel& one, const SurfacePixel& other) {
  return !one.background() && one.found && other.found && one.color == other.color;
}

std::array<size_t, 4> neighbours(size_t at, size_t width) { return {at - 1, at + 1, at - width, at + width}; }

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
  PixelMask mask = inside_surfaces(reference, width, height);
  for (size_t at = 0; at < mask.pixels.size(); ++at) {
    if (mask.pixels[at] == 0) continue;
    mask.pixels[at] = std::ranges::all_of(neighbours(at, static_cast<size_t>(width)), [&](size_t next) {
      return difference(reference_colors, next, reference_colors, at) <= smooth;
    });
  }
  return shade_differences_in(mask, reference, reference_colors, shown, shown_colors);
}

ShadeDifferences shade_differences_in(const PixelMask& mask, std::span<const SurfacePixel> reference,
                                      std::span<const uint8_t> reference_colors,
                                      std::span<const SurfacePixel> shown,
                                      std::span<const uint8_t> shown_colors) {
  ShadeDifferences differences;
  for (size_t at = 0; at < mask.pixels.size(); ++at) {
    if (mask.pixels[at] != 0 && alike(shown[at], reference[at]))
      differences.add(static_cast<uint8_t>(difference(reference_colors, at, shown_colors, at)));
  }
  return differences;
}

PixelMask inside_surfaces(std::span<const SurfacePixel> reference, int width, int height) {
  PixelMask mask(width, height);
  const auto w = static_cast<size_t>(width);
  for (int y = 1; y + 1 < height; ++y) {
    for (int x = 1; x + 1 < width; ++x) {
      const size_t at = static_cast<size_t>(y) * w + static_cast<size_t>(x);
      mask.at(x, y) = std::ranges::all_of(neighbours(at, w),
                                          [&](size_t next) { return alike(reference[next], reference[at]); });
    }
  }
  return mask;
}

}  // namespace triptych
