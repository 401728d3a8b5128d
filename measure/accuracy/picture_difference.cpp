#include "measure/accuracy/picture_difference.hpp"

#include "base/threads.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace triptych {

namespace {

constexpr int reach = 5;

std::array<double, 2 * reach + 1> gaussian() {
  std::array<double, 2 * reach + 1> weights;
  for (int i = -reach; i <= reach; ++i)
    weights[static_cast<size_t>(i + reach)] = std::exp(-i * i / (2 * 1.5 * 1.5));
  return weights;
}

/// A picture of one value a pixel.
struct Values {
  Values(int w, int h) : width(w), height(h), values(static_cast<size_t>(w) * static_cast<size_t>(h)) {}
  double& at(int x, int y) {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  double at(int x, int y) const {
    return values[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
  int width, height;
  std::vector<double> values;
};

/// Weighted means over the window around each pixel.
Values blurred(const Values& values) {
  static const auto weights = gaussian();
  const auto along = [&](const Values& from, bool across) {
    Values to(from.width, from.height);
    parallel_for(static_cast<size_t>(from.height), [&](size_t row) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < from.width; ++x) {
        const int place = across ? x : y, end = across ? from.width : from.height;
        double sum = 0, weight = 0;
        for (int i = std::max(-reach, -place); i <= std::min(reach, end - 1 - place); ++i) {
          const double w = weights[static_cast<size_t>(i + reach)];
          sum += w * (across ? from.at(x + i, y) : from.at(x, y + i));
          weight += w;
        }
        to.at(x, y) = sum / weight;
      }
    });
    return to;
  };
  return along(along(values, true), false);
}

Values brightness(std::span<const uint8_t> rgba, int width, int height) {
  Values values(width, height);
  for (size_t i = 0; i < values.values.size(); ++i)
    values.values[i] = 0.299 * rgba[4 * i] + 0.587 * rgba[4 * i + 1] + 0.114 * rgba[4 * i + 2];
  return values;
}

Values product(const Values& a, const Values& b) {
  Values values(a.width, a.height);
  for (size_t i = 0; i < values.values.size(); ++i) values.values[i] = a.values[i] * b.values[i];
  return values;
}

}  // namespace

double structural_similarity(std::span<const uint8_t> one, std::span<const uint8_t> other, int width,
                             int height) {
  constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
  const Values a = brightness(one, width, height), b = brightness(other, width, height);
  const Values mean_a = blurred(a), mean_b = blurred(b);
  const Values aa = blurred(product(a, a)), bb = blurred(product(b, b)), ab = blurred(product(a, b));
  double sum = 0;
  for (size_t i = 0; i < a.values.size(); ++i) {
    const double ma = mean_a.values[i], mb = mean_b.values[i];
    const double variance_a = aa.values[i] - ma * ma, variance_b = bb.values[i] - mb * mb;
    const double covariance = ab.values[i] - ma * mb;
    sum += (2 * ma * mb + c1) * (2 * covariance + c2) /
           ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
  }
  return sum / static_cast<double>(a.values.size());
}

PictureDifference picture_difference(std::span<const uint8_t> reference, std::span<const uint8_t> shown,
                                     int width, int height) {
  PictureDifference difference;
  for (size_t i = 0; i + 3 < reference.size(); i += 4) {
    if (std::memcmp(&reference[i], &shown[i], 3) == 0) continue;
    ++difference.wrong_pixels;
    for (size_t channel = 0; channel < 3; ++channel) {
      const double apart = double{static_cast<double>(reference[i + channel])} - shown[i + channel];
      difference.squared_error += apart * apart;
    }
  }
  if (difference.wrong_pixels > 0) difference.ssim = structural_similarity(reference, shown, width, height);
  return difference;
}

}  // namespace triptych
