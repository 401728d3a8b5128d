#include "samples/surfaces/statue.hpp"

#include "samples/orbits.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace triptych {
namespace {

using Point = glm::dvec3;

const Point room_low(-0.62, -0.03, -0.5), room_high(0.62, 2.62, 0.5);

/// A ball that is rolled from a to b while its radius goes from r to s, blended into the others over `blend`.
struct Limb {
  Point a, b;
  double r, s, blend;
};

/// Quilez 2018, "Rounded cone": the exact distance.
double distance_to(const Limb& limb, const Point& p) {
  const Point ba = limb.b - limb.a, pa = p - limb.a;
  const double l2 = glm::dot(ba, ba), rr = limb.r - limb.s, a2 = l2 - rr * rr, il2 = 1 / l2;
  const double y = glm::dot(pa, ba), z = y - l2;
  const Point across = pa * l2 - ba * y;
  const double x2 = glm::dot(across, across), y2 = y * y * l2, z2 = z * z * l2;
  const double k = (rr > 0 ? 1.0 : rr < 0 ? -1.0 : 0.0) * rr * rr * x2;
  if ((z > 0 ? 1 : -1) * a2 * z2 > k) return std::sqrt(x2 + z2) * il2 - limb.s;
  if ((y > 0 ? 1 : -1) * a2 * y2 < k) return std::sqrt(x2 + y2) * il2 - limb.r;
  return (std::sqrt(x2 * a2 * il2) + y * rr) * il2 - limb.r;
}

/// Quilez's polynomial smooth minimum: a mix of its arguments' gradients, and never steeper than they are.
double smooth_least(double a, double b, double k) {
  const double h = std::max(k - std::abs(a - b), 0.0) / k;
  return std::min(a, b) - h * h * k / 4;
}

double box_distance(const Point& p, const Point& half, double rounding) {
  const Point q = glm::abs(p) - half + rounding;
  return glm::length(glm::max(q, 0.0)) + std::min(std::max({q.x, q.y, q.z}), 0.0) - rounding;
}

std::vector<Limb> make_limbs() {
  const auto mirrored = [](Point p) { return Point(-p.x, p.y, p.z); };
  std::vector<Limb> limbs{
      // The robe from the ground to the waist, trunk and shoulders.
      {{0.0, 0.50, -0.02}, {0.0, 1.18, 0.0}, 0.26, 0.135, 0.08},
      {{0.06, 0.46, 0.06}, {0.05, 1.0, 0.05}, 0.19, 0.11, 0.08},
      {{0.0, 1.2, 0.0}, {0.0, 1.58, -0.01}, 0.135, 0.125, 0.08},
      {{-0.14, 1.66, -0.015}, {0.14, 1.66, -0.015}, 0.068, 0.068, 0.1},
      {{-0.075, 1.5, 0.085}, {0.075, 1.5, 0.085}, 0.06, 0.06, 0.06},
      // Neck, head, chin, nose, and the hair with its knot.
      {{0.0, 1.66, -0.01}, {0.0, 1.86, 0.01}, 0.052, 0.048, 0.05},
      {{0.0, 1.945, 0.0}, {0.0, 1.885, 0.035}, 0.098, 0.07, 0.03},
      {{0.0, 1.925, 0.098}, {0.0, 1.895, 0.113}, 0.008, 0.015, 0.02},
      {{-0.033, 1.945, 0.084}, {-0.012, 1.945, 0.09}, 0.012, 0.008, 0.012},
      {{0.033, 1.945, 0.084}, {0.012, 1.945, 0.09}, 0.012, 0.008, 0.012},
      {{0.0, 1.865, 0.086}, {0.0, 1.86, 0.087}, 0.018, 0.018, 0.012},
      {{0.0, 1.965, -0.03}, {0.0, 1.92, -0.05}, 0.108, 0.09, 0.02},
      {{0.0, 1.93, -0.15}, {0.0, 1.90, -0.17}, 0.05, 0.04, 0.03},
      {{0.05, 1.86, -0.1}, {0.11, 1.62, -0.09}, 0.045, 0.03, 0.04},
      {{-0.05, 1.86, -0.1}, {-0.11, 1.62, -0.09}, 0.045, 0.03, 0.04},
      // The arm with the torch, and its sleeve.
      {{0.19, 1.66, 0.0}, {0.34, 1.82, 0.03}, 0.066, 0.05, 0.06},
      {{0.34, 1.82, 0.03}, {0.37, 2.1, 0.08}, 0.048, 0.033, 0.03},
      {{0.37, 2.14, 0.09}, {0.375, 2.17, 0.1}, 0.042, 0.036, 0.02},
      {{0.2, 1.62, -0.02}, {0.33, 1.72, 0.0}, 0.075, 0.085, 0.07},
      {{0.37, 2.05, 0.115}, {0.38, 2.32, 0.1}, 0.018, 0.032, 0.01},
      {{0.38, 2.34, 0.1}, {0.38, 2.35, 0.1}, 0.062, 0.062, 0.02},
      {{0.38, 2.40, 0.1}, {0.385, 2.52, 0.1}, 0.05, 0.008, 0.03},
      // The other arm holds a tablet.
      {mirrored({0.19, 1.66, 0.0}), mirrored({0.27, 1.38, 0.0}), 0.068, 0.055, 0.07},
      {mirrored({0.27, 1.38, 0.0}), mirrored({0.2, 1.33, 0.22}), 0.055, 0.034, 0.05},
      {mirrored({0.24, 1.5, -0.01}), mirrored({0.27, 1.22, 0.05}), 0.07, 0.085, 0.07},
  };
  // Two folds of the cloak that fall from shoulder to hem.
  limbs.push_back({{0.16, 1.62, 0.07}, {-0.12, 1.12, 0.14}, 0.035, 0.04, 0.05});
  limbs.push_back({{-0.12, 1.12, 0.14}, {-0.22, 0.6, 0.13}, 0.04, 0.06, 0.07});
  limbs.push_back({{-0.13, 1.6, -0.08}, {-0.2, 0.55, -0.17}, 0.05, 0.09, 0.1});
  return limbs;
}

class Statue : public Field {
 public:
  Statue(uint64_t seed, double step) : limbs_(make_limbs()) {
    const auto stream = static_cast<uint32_t>(seed * 64);
    warp_ = {2.3, 1.6, stream};
    fray_ = {5.1, 0.9, stream + 1};
    strands_ = {9.0, 2.4, stream + 2};
    double frequency = 21, amplitude = 0.0034;
    for (uint32_t i = 3; i < 12; ++i, frequency *= 2.07, amplitude *= 0.52) {
      const double samples = 1 / (frequency * step), shown = std::clamp(samples / 4 - 1, 0.0, 1.0);
      if (shown > 0) grain_.push_back({frequency, amplitude * shown, stream + i});
    }
    // Folds and strands, too, need some samples a wave.
    folds_ = std::clamp(0.05 / step - 1, 0.0, 1.0);
    pleats_ = std::clamp(0.014 / step - 1, 0.0, 1.0);
    hair_ = std::clamp(0.008 / step - 1, 0.0, 1.0);
  }

  void evaluate(const SampleRow& row, std::span<float> values) const override {
    // The body's distance grows by at most a step each step: far from it, samples can be passed over.
    constexpr double max_displaced = 0.045;
    for (size_t i = 0; i < values.size();) {
      const Point p(row.x + static_cast<double>(i) * row.step, row.y, row.z);
      const double body = body_at(p);
      if (std::abs(body) <= max_displaced) {
        values[i++] = static_cast<float>(body + displacement(p));
        continue;
      }
      const auto passed = 1 + static_cast<size_t>((std::abs(body) - max_displaced) / row.step);
      const size_t end = std::min(values.size(), i + passed);
      for (; i < end; ++i) values[i] = static_cast<float>(body);
    }
  }

 private:
  double body_at(const Point& p) const {
    double least = box_distance(p - Point(0, 0.1, 0), {0.42, 0.1, 0.42}, 0.015);
    least = std::min(least, box_distance(p - Point(0, 0.22, 0), {0.36, 0.08, 0.36}, 0.03));
    for (const Limb& limb : limbs_) least = smooth_least(least, distance_to(limb, p), limb.blend);
    // The tablet in the left hand.
    const Point q = p - Point(-0.2, 1.42, 0.27);
    const double lean = 0.25, c = std::cos(lean), s = std::sin(lean);
    return smooth_least(
        least, box_distance({q.x, c * q.y + s * q.z, c * q.z - s * q.y}, {0.1, 0.15, 0.022}, 0.012), 0.012);
  }

  double displacement(const Point& p) const {
    double result = 0;
    const double robe = glm::smoothstep(0.31, 0.4, p.y) * (1 - glm::smoothstep(1.6, 1.72, p.y)) *
                        (1 - glm::smoothstep(0.16, 0.2, p.z) * glm::smoothstep(1.2, 1.3, p.y));
    if (robe > 0) {
      const double angle = std::atan2(p.z, p.x), drift = noise_at(warp_, p) + noise_at(fray_, p);
      const double deep = 0.017 * (0.35 + 0.65 * (1 - glm::smoothstep(0.5, 1.5, p.y)));
      result += robe * folds_ * deep * std::sin(13 * angle + 2.2 * drift + 2 * p.y);
      result += robe * pleats_ * 0.0045 * std::sin(47 * angle + 5.0 * drift - 5 * p.y);
    }
    const double hair = glm::smoothstep(1.76, 1.82, p.y) * (1 - glm::smoothstep(0.0, 0.035, p.z)) *
                        (1 - glm::smoothstep(0.15, 0.19, std::abs(p.x)));
    if (hair > 0) {
      const double way = noise_at(strands_, p);
      result += hair * hair_ * 0.0035 * std::sin(300 * (p.x + 0.25 * p.y) + 3 * way);
      result += hair * folds_ * 0.005 * std::sin(85 * (p.x + 0.3 * p.z) + 4 * way);
    }
    const double bare = p.y > 1.72 && p.z > 0 ? 0.12 : 1.0;  // skin is smoother than cloth and stone
    for (const NoiseOctave& octave : grain_) result += bare * noise_at(octave, p);
    return result;
  }

  std::vector<Limb> limbs_;
  NoiseOctave warp_, fray_, strands_;
  std::vector<NoiseOctave> grain_;
  double folds_ = 1, pleats_ = 1, hair_ = 1;
};

}  // namespace

std::unique_ptr<Field> statue_field(uint64_t seed, double step) {
  return std::make_unique<Statue>(seed, step);
}

SurfaceReport make_statue(const SurfaceOptions& options, const std::filesystem::path& folder) {
  check_surface_options("sample statue", options);
  const auto field = [&](double step) { return statue_field(options.seed, step); };
  const SurfaceReport report =
      write_surface(field, room_low, room_high, options.triangles, folder, "triptych sample statue");
  write_orbits({.centre = {0, 1.3, 0},
                .radius = 3,
                .closest = 0.8,
                .low = 0.7,
                .high = 2.3,
                .spin = {0.05, 1.8, 0.85}},
               Random(options.seed), folder);
  return report;
}

}  // namespace triptych
