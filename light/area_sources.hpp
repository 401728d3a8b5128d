// Surfaces that light comes from, as they are sampled: those that emit, or that reflect much.
#pragma once

#include "light/lit_scene.hpp"
#include "scene/box.hpp"
#include "scene/skeleton.hpp"

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

/// Relative luminance of linear colours (IEC 61966-2-1).
inline double luminance(const glm::dvec3& color) {
  return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

/// The triangles of a scene whose luminance is above a limit, by placement. Each is as likely to be sampled
/// as its luminance times its area, and placements by what of theirs comes to a place.
class AreaSources {
 public:
  /// None.
  AreaSources() = default;
  /// luminances: for each triangle of the scene, which must outlive this.
  AreaSources(const LitScene& scene, std::vector<float> luminances, double least);

  bool empty() const { return bodies_.empty(); }
  uint64_t triangles() const { return triangles_; }

  /// How likely each placement is chosen at a place on a surface with the normal; empty if none of them is
  /// above its horizon.
  std::vector<double> chances(const glm::dvec3& position, const glm::dvec3& normal) const;

  struct Sample {
    uint32_t triangle = 0;
    double u = 0, v = 0;  ///< shares of its second and third corner
    glm::dvec3 position;
  };
  /// choice, place: in the unit square; the choice's x, from 0 to 1, is spread over the chances.
  Sample sample(const std::vector<double>& chances, const glm::dvec2& choice, const glm::dvec2& place) const;
  /// Per unit of area of the triangle, which may be of another scene than the sources', of the same model:
  /// `luminance` and `instance` are its own.
  double density(const std::vector<double>& chances, uint32_t instance, double luminance) const;

 private:
  struct Body {
    std::vector<uint32_t> triangles;
    std::vector<double> powers;  ///< luminance times area, up to and with each of them
    Box box;
    double power() const { return powers.back(); }
  };
  const LitScene* scene_ = nullptr;
  double least_ = 0;
  std::vector<Body> bodies_;
  std::vector<uint32_t> body_of_;  ///< for each instance, or no_id
  uint64_t triangles_ = 0;
};

}  // namespace triptych
