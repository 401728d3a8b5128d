// What a frame will cost: a sum over its work, calibrated on this machine and device.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace triptych {

/// What is known of a frame's work before it is drawn: each is a term of its cost.
struct FrameWork {
  double megapixels = 0;          ///< of the picture
  double covered_megapixels = 0;  ///< by each drawable by itself, summed: more than the picture has
  double triangles = 0;           ///< of the drawables
  double large_triangles = 0;     ///< of those, the ones that may fill many pixels each; in between in part
  double drawables = 0;
  double new_triangles = 0;  ///< of chunks that no frame has drawn yet: they are read and decoded first

  static constexpr size_t terms = 6;
  using Values = std::array<double, terms>;
  Values values() const {
    return {megapixels, covered_megapixels, triangles, large_triangles, drawables, new_triangles};
  }
  /// "megapixels", "covered_megapixels" …, in this order.
  static const std::array<std::string, terms>& names();
};

/// Term by term the larger one.
FrameWork at_least(const FrameWork& a, const FrameWork& b);

/// Milliseconds for one of each, in the order of FrameWork::values().
using CostCoefficients = FrameWork::Values;

/// Cost = Σ coefficient · work, no coefficient negative (Funkhouser and Séquin, Adaptive Display Algorithm
/// for Interactive Frame Rates, SIGGRAPH 1993; where a graphics pipeline takes the time of its slowest stage,
/// a processor that runs all stages takes their sum). The coefficients are least squares of relative errors
/// over the frames so far, whose weight fades, held to the calibration; the sum is multiplied by a factor
/// that follows what the last frames took over it. Never NaN, whatever it is told.
class CostModel {
 public:
  /// Begins with coefficients as of a processor of some years ago.
  CostModel();

  /// Milliseconds, above 0.
  double predict(const FrameWork& work) const;
  /// A frame of this work took so many milliseconds. Ignored where they are not above 0, or not finite.
  void learn(const FrameWork& work, double milliseconds);
  /// The calibration is over: what was learnt in it is what later coefficients are held to.
  void end_calibration();

  const CostCoefficients& coefficients() const { return coefficients_; }
  double factor() const { return factor_; }

 private:
  double sum(const FrameWork::Values& work) const;
  void fit();

  CostCoefficients held_to_, coefficients_;
  std::array<FrameWork::Values, FrameWork::terms> products_{};  ///< Σ weight · work · workᵀ
  FrameWork::Values responses_{};                               ///< Σ weight · work · milliseconds
  double factor_ = 1;
};

}  // namespace triptych
