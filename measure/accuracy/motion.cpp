#include "measure/accuracy/motion.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace triptych {

namespace {

/// What no shading of a moving camera does from frame to frame, and what it may, of 255.
constexpr int far_change = 24, small_change = 8;

int change(std::span<const uint8_t> one, std::span<const uint8_t> other, size_t pixel) {
  int largest = 0;
  for (size_t channel = 0; channel < 3; ++channel)
    largest = std::max(largest, std::abs(int{one[4 * pixel + channel]} - int{other[4 * pixel + channel]}));
  return largest;
}

}  // namespace

double popping(std::span<const uint8_t> reference_before, std::span<const uint8_t> reference,
               std::span<const uint8_t> shown_before, std::span<const uint8_t> shown, int width, int height) {
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  std::vector<int> allowed(w * h);
  for (size_t pixel = 0; pixel < w * h; ++pixel) allowed[pixel] = change(reference_before, reference, pixel);
  uint64_t beyond = 0;
  for (size_t y = 0; y < h; ++y) {
    for (size_t x = 0; x < w; ++x) {
      const int changed = change(shown_before, shown, y * w + x);
      if (changed <= allowed[y * w + x]) continue;
      int most = 0;
      for (size_t row = y > 0 ? y - 1 : 0; row < std::min(y + 2, h); ++row) {
        for (size_t column = x > 0 ? x - 1 : 0; column < std::min(x + 2, w); ++column)
          most = std::max(most, allowed[row * w + column]);
      }
      beyond += static_cast<uint64_t>(std::max(changed - most, 0));
    }
  }
  return static_cast<double>(beyond) / static_cast<double>(w * h);
}

uint64_t flickering_pixels(std::span<const uint8_t> first, std::span<const uint8_t> second,
                           std::span<const uint8_t> third) {
  uint64_t count = 0;
  for (size_t pixel = 0; 4 * pixel < first.size(); ++pixel) {
    count += change(first, second, pixel) > far_change && change(second, third, pixel) > far_change &&
             change(first, third, pixel) <= small_change;
  }
  return count;
}

}  // namespace triptych
