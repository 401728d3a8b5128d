#include "nodes/cost_model.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

/// Microseconds a triangle would be a thousandth of these.
constexpr CostCoefficients first_guess = {2, 0.2, 30e-6, 100e-6, 5e-3, 500e-6};
/// How much of its weight a frame keeps when the next one comes: half of it after 5.
constexpr double fading = 0.87;
/// A coefficient that is off by all of itself weighs as much as this relative error, squared.
constexpr double hold = 0.002;
/// How fast the factor follows; how far, so that a frame that was disturbed counts little; and its limits.
constexpr double following = 0.15, max_change = 1.5, max_factor = 8;
constexpr double min_ms = 1e-6;

bool all_finite(const FrameWork::Values& values) {
  return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

const std::array<std::string, FrameWork::terms>& FrameWork::names() {
  static const std::array<std::string, terms> names = {
      "megapixels", "covered_megapixels", "triangles", "large_triangles", "drawables", "new_triangles"};
  return names;
}

FrameWork at_least(const FrameWork& a, const FrameWork& b) {
  return {.megapixels = std::max(a.megapixels, b.megapixels),
          .covered_megapixels = std::max(a.covered_megapixels, b.covered_megapixels),
          .triangles = std::max(a.triangles, b.triangles),
          .large_triangles = std::max(a.large_triangles, b.large_triangles),
          .drawables = std::max(a.drawables, b.drawables),
          .new_triangles = std::max(a.new_triangles, b.new_triangles)};
}

CostModel::CostModel() : held_to_(first_guess), coefficients_(first_guess) {}

double CostModel::sum(const FrameWork::Values& work) const {
  double sum = 0;
  for (size_t i = 0; i < work.size(); ++i) sum += coefficients_[i] * work[i];
  return std::max(sum, min_ms);
}

double CostModel::predict(const FrameWork& work) const { return factor_ * sum(work.values()); }

void CostModel::learn(const FrameWork& work, double milliseconds) {
  const FrameWork::Values values = work.values();
  if (!all_finite(values) || !std::isfinite(milliseconds) || milliseconds < min_ms) return;
  const double ratio = std::clamp(milliseconds / sum(values), factor_ / max_change, factor_ * max_change);
  factor_ = std::clamp(factor_ + following * (ratio - factor_), 1 / max_factor, max_factor);
  const double weight = 1 / (milliseconds * milliseconds);
  for (size_t i = 0; i < values.size(); ++i) {
    responses_[i] = fading * responses_[i] + weight * values[i] * milliseconds;
    for (size_t j = 0; j < values.size(); ++j)
      products_[i][j] = fading * products_[i][j] + weight * values[i] * values[j];
  }
  fit();
}

/// Each coefficient in turn is set to its best value while the others stay, at least 0: the sum of squares is
/// convex, so that this converges.
void CostModel::fit() {
  constexpr int rounds = 50;
  for (int round = 0; round < rounds; ++round) {
    for (size_t i = 0; i < coefficients_.size(); ++i) {
      const double held = hold / (held_to_[i] * held_to_[i]);
      double best = responses_[i] + held * held_to_[i];
      for (size_t j = 0; j < coefficients_.size(); ++j)
        if (j != i) best -= products_[i][j] * coefficients_[j];
      coefficients_[i] = std::max(0.0, best / (products_[i][i] + held));
    }
  }
}

void CostModel::end_calibration() {
  // One that the calibration found to be 0 may become larger again.
  constexpr double least = 0.01;
  for (size_t i = 0; i < held_to_.size(); ++i)
    held_to_[i] = std::max(coefficients_[i], least * first_guess[i]);
}

}  // namespace triptych
