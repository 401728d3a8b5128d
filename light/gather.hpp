// The light that comes to a point of a surface.
#pragma once

#include "light/emitters.hpp"
#include "light/light_points.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace triptych {

/// A point on one side of a surface.
struct GatherPlace {
  glm::dvec3 position;  ///< where rays start
  glm::dvec3 normal;    ///< of unit length, to the side
  uint64_t seed = 0;    ///< of the rays' directions
};

/// In front of the point, or behind it.
GatherPlace gather_place(const LightPoint& point, bool back, double clearance, uint64_t seed);

/// What comes without any bounce.
struct DirectLight {
  glm::dvec3 irradiance{0};  ///< lux
  double openness = 1;       ///< the cosine-weighted share of directions in which nothing is near
  double backs = 0;          ///< the share of rays that met the backs of triangles
};

/// Whether the first side is within a closed surface, and the other one is not: nearly all that it sees are
/// backs.
inline bool is_inside(const DirectLight& side, const DirectLight& other) {
  constexpr double mostly = 0.9;
  return side.backs > mostly && other.backs <= mostly;
}

class Gatherer {
 public:
  /// All must outlive it. lights: of the emitters' own scene, which may be coarser than `scene`.
  Gatherer(const LitScene& scene, const LitScene& light_scene, const Emitters& emitters,
           const LightOptions& options)
      : scene_(scene), light_scene_(light_scene), emitters_(emitters), options_(options) {}

  /// samples: rays over the hemisphere, and a quarter of them to surfaces that emit, by multiple importance
  /// sampling with the balance heuristic (Veach and Guibas, Optimally combining sampling techniques, 1995).
  /// Lights that are points each get a ray of their own up to so many. looks_around: also where there is no
  /// surface to find, for openness and backs.
  DirectLight direct(const GatherPlace& place, uint32_t samples, bool looks_around) const;
  /// What surfaces reflect that have this irradiance at their points: final gathering over the hemisphere.
  /// bright: those that reflect most, which get rays of their own, as emitters do.
  glm::dvec3 bounced(const GatherPlace& place, uint32_t samples, std::span<const glm::vec3> points,
                     const AreaSources& bright) const;

 private:
  /// What a surface sends on at a place, and its luminance as AreaSources knows it.
  struct Sent {
    glm::dvec3 radiance;
    double luminance;
  };
  using SentBy = std::function<Sent(const LitScene&, uint32_t triangle, double u, double v)>;
  /// The irradiance of surfaces. sources: of this scene.
  DirectLight from_surfaces(const GatherPlace& place, uint32_t samples, const AreaSources& sources,
                            const LitScene& scene_of_sources, const SentBy& sent) const;
  glm::dvec3 from_lights(const GatherPlace& place, uint32_t samples) const;
  /// The irradiance that the light would give without anything between, and the way to it.
  glm::dvec3 unshadowed(const GatherPlace& place, const ModelLight& light) const;
  double passes(const GatherPlace& place, const ModelLight& light) const;

  const LitScene& scene_;
  const LitScene& light_scene_;
  const Emitters& emitters_;
  const LightOptions& options_;
};

/// The surfaces of the scene that reflect so much more than others that rays over the hemisphere, which
/// seldom meet them, would make noise of them.
AreaSources bright_surfaces(const LitScene& scene, std::span<const glm::vec3> points);

/// Of a triangle with the colours of its corners, if it has any: linear, at most 0.9 since nothing reflects
/// all.
glm::dvec3 reflectance_of(const LitScene& scene, uint32_t triangle);

}  // namespace triptych
