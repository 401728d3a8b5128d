#include "scene/linear_light.hpp"

namespace triptych {

namespace {

/// By Newton's method.
double fifth_root(double value) {
  double root = 1;
  constexpr int enough = 100;
  for (int i = 0; i < enough; ++i) {
    const double squared = root * root;
    root = (4 * root + value / (squared * squared)) / 5;
  }
  return root;
}

/// The curve of sRGB (IEC 61966-2-1), both 0 to 1.
double linear_of(double displayed) {
  if (displayed <= 0.04045) return displayed / 12.92;
  const double base = (displayed + 0.055) / 1.055, squared = base * base;
  return squared * fifth_root(squared);  // to the power 2.4
}

}  // namespace

const LinearLight& LinearLight::table() {
  static const LinearLight table;
  return table;
}

LinearLight::LinearLight() : displayed_(new uint8_t[most + 1]) {
  for (uint32_t i = 0; i < linear_.size(); ++i)
    linear_[i] = static_cast<uint16_t>(linear_of(i / 255.0) * most + 0.5);
  uint32_t linear = 0;
  for (uint32_t i = 0; i < 256; ++i) {
    const double end = i == 255 ? most + 1.0 : linear_of((i + 0.5) / 255) * most;
    for (; linear < end; ++linear) displayed_[linear] = static_cast<uint8_t>(i);
  }
}

}  // namespace triptych
