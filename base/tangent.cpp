#include "base/tangent.hpp"

#include "base/rounding.hpp"

#include <cmath>

namespace triptych {

namespace {

// π/2 in two doubles.
constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_rest = 0x1.1a62633145c07p-54;

/// Σ (−y²)ⁱ / (first · (first + 1) …): the series of sine and cosine, without their first factor. For |y| ≤
/// π/4 twelve terms leave less than 2⁻⁶⁰.
double series(double squared, int first) {
  double sum = 1;
  for (int term = 11; term > 0; --term) {
    const double k = first + 2 * (term - 1);
    sum = 1 - squared / (k * (k + 1)) * sum;
  }
  return sum;
}

double sine(double y) { return y * series(y * y, 2); }
double cosine(double y) { return series(y * y, 1); }

double positive_tangent(double x) {
  if (x <= half_pi / 2) return sine(x) / cosine(x);
  const double rest = (half_pi - x) + half_pi_rest;
  return cosine(rest) / sine(rest);
}

}  // namespace

double tangent(double radians) {
  return round_to_nearest(
      [&] { return radians < 0 ? -positive_tangent(-radians) : positive_tangent(radians); });
}

}  // namespace triptych
