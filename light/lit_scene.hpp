// Rays through a model whose light is baked (Embree).
#pragma once

#include "light/lit_model.hpp"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace triptych {

/// How a material meets light.
struct LitSurface {
  glm::dvec3 reflectance{0.8};  ///< diffuse, linear red, green, blue
  glm::dvec3 radiance{0};       ///< that it emits to both sides, cd/m²
  double opacity = 1;           ///< of what comes, 1 − opacity passes straight through
};

class LitScene {
 public:
  /// Both must outlive it; surfaces: for each material.
  LitScene(const LitModel& model, const std::vector<LitSurface>& surfaces);
  ~LitScene();
  LitScene(const LitScene&) = delete;
  LitScene& operator=(const LitScene&) = delete;

  struct Hit {
    uint32_t triangle = 0;
    double u = 0, v = 0;  ///< shares of the second and third corner
    double distance = 0;  ///< model units
    bool back = false;    ///< whether the ray came from behind
    double share = 1;     ///< of the light from there that arrives
  };
  /// What the ray meets, from near to far, until something opaque; at most `most_layers` transparent ones.
  /// direction: of unit length.
  void trace(const glm::dvec3& origin, const glm::dvec3& direction,
             const std::function<void(const Hit&)>& take) const;
  /// How much of the light goes from one point to the other; cut-outs count as whole.
  double passes(const glm::dvec3& from, const glm::dvec3& to) const;
  /// The same from infinitely far in the direction.
  double passes_from_sky(const glm::dvec3& from, const glm::dvec3& direction) const;

  const LitModel& model() const { return model_; }
  const LitSurface& surface(uint32_t triangle) const {
    return surfaces_[model_.triangles[triangle].material];
  }
  /// By how much starts of rays lie off the surface, model units.
  double clearance() const { return model_.diagonal * 1e-5; }

 private:
  static constexpr int most_layers = 16;
  double share_along(const glm::dvec3& origin, const glm::dvec3& direction, double length) const;

  const LitModel& model_;
  const std::vector<LitSurface>& surfaces_;
  glm::dvec3 middle_{0};
  bool has_transparent_ = false;
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace triptych
