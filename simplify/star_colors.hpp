// The colours around a point, and what becomes of them when it moves to a neighbour.
#pragma once

#include "simplify/star.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

namespace triptych {

class StarColors {
 public:
  /// The colours of the star's corners; the mesh must have some.
  void read(const ShrinkingMesh& mesh, uint32_t point, std::span<const Spoke> spokes);

  /// How distinct the point's colour is from that of a neighbour, 0 to 1.
  double difference(uint32_t neighbour) const;

  /// What becomes of a fan.
  struct Change {
    double color =
        0;  ///< how distinct colours and baked light are from before, where they differ most, 0 to 1
    double texture = 0;  ///< how far on the surface a texture has moved, where that is most
  };
  /// Once the point is at the target; compared where the point was, and halfway to its neighbours. A texture
  /// has moved as far as the surface reaches between where it was and where it is (Cohen, Olano and Manocha,
  /// Appearance-preserving simplification, 1998); where it does not vary over a triangle, as far as the
  /// point. from, to: of all spokes, relative to the point; way: to the target. `removed`: for each spoke a
  /// negative number if its triangle goes.
  Change change(const Star::Fan& fan, uint32_t target, std::span<const glm::dvec3> from,
                std::span<const glm::dvec3> to, const glm::dvec3& way, std::span<const double> removed);

  /// What the corner of a spoke that was at the point has at the target, after change() of its fan.
  const SurfaceCorner& at_target(size_t spoke) const { return moved_[spoke]; }

 private:
  struct Corners {
    SurfaceCorner point, from, to;
  };
  struct Sample {
    size_t spoke;
    glm::dvec3 place, color;
    glm::dvec4 light;
    glm::dvec2 coordinates;
  };
  SurfaceCorner nearest_at(uint32_t target, const Star::Fan& fan, const SurfaceCorner& own) const;

  std::span<const Spoke> spokes_;
  std::vector<Corners> corners_;      ///< for each spoke
  std::vector<SurfaceCorner> moved_;  ///< for each spoke
  std::vector<Sample> samples_;
};

}  // namespace triptych
