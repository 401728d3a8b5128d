// The colours around a point, and what becomes of them when it moves to a neighbour.
#pragma once

#include "simplify/star.hpp"

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

class StarColors {
 public:
  /// The colours of the star's corners; the mesh must have some.
  void read(const ShrinkingMesh& mesh, uint32_t point, std::span<const Spoke> spokes);

  /// How distinct the point's colour is from that of a neighbour, 0 to 1.
  double difference(uint32_t neighbour) const;

  /// How distinct from before colours in a fan are, where they differ most, once the point is at the target:
  /// 0 to 1. Compared where the point was, and halfway to its neighbours. from, to: of all spokes, relative
  /// to the point; way: to the target. `removed`: for each spoke a negative number if its triangle goes.
  double change(const Star::Fan& fan, uint32_t target, std::span<const glm::dvec3> from,
                std::span<const glm::dvec3> to, const glm::dvec3& way, std::span<const double> removed);

  /// What the corner of a spoke that was at the point has at the target, after change() of its fan.
  const VertexColor& at_target(size_t spoke) const { return moved_[spoke]; }

 private:
  struct Corners {
    VertexColor point, from, to;
  };
  struct Sample {
    glm::dvec3 place, color;
  };
  VertexColor nearest_at(uint32_t target, const Star::Fan& fan, const VertexColor& own) const;

  std::span<const Spoke> spokes_;
  std::vector<Corners> corners_;    ///< for each spoke
  std::vector<VertexColor> moved_;  ///< for each spoke
  std::vector<Sample> samples_;
};

}  // namespace triptych
