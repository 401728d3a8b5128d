// The shading normal of a vertex: an attribute of its own beside the position, where a model has one.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

namespace triptych {

/// A direction on the octahedron |x| + |y| + |z| = 1, its lower half folded over the upper one, by its x and
/// y (Meyer, Süßmuth, Sußner, Stamminger and Greiner, On floating-point normal vectors, 2010): −1 to 1 as 1
/// to 2047, to a sixth of a degree. Both zero where the vertex has no normal of its own: then that of its
/// triangle shows.
using VertexNormal = std::array<uint16_t, 2>;

/// Of the corners of a triangle: of all of them, or of none.
using CornerNormals = std::array<VertexNormal, 3>;

inline constexpr int normal_middle = 1024, normal_reach = 1023;

inline bool has_normal(const VertexNormal& normal) { return normal[0] != 0; }
inline bool is_vertex_normal(const VertexNormal& normal) {
  constexpr int most = normal_middle + normal_reach;
  return normal[0] > 0 && normal[0] <= most && normal[1] > 0 && normal[1] <= most;
}

/// The nearest one to a direction of any length; none for one without a direction, or that is not finite.
inline VertexNormal to_vertex_normal(const glm::dvec3& direction) {
  const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
  if (!(sum > 0) || !std::isfinite(sum)) return {};
  double x = direction.x / sum, y = direction.y / sum;
  if (direction.z < 0) {
    const double folded = std::copysign(1 - std::abs(y), x);
    y = std::copysign(1 - std::abs(x), y);
    x = folded;
  }
  return {static_cast<uint16_t>(normal_middle + std::lround(normal_reach * x)),
          static_cast<uint16_t>(normal_middle + std::lround(normal_reach * y))};
}

/// The direction, of a length between 0.5 and 1.
template <typename Vector = glm::dvec3>
Vector direction_of(const VertexNormal& normal) {
  using Value = typename Vector::value_type;
  const Value x = static_cast<Value>(normal[0] - normal_middle) / normal_reach,
              y = static_cast<Value>(normal[1] - normal_middle) / normal_reach;
  const Value z = (1 - std::abs(x)) - std::abs(y);
  if (z >= 0) return {x, y, z};
  return {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y), z};
}

}  // namespace triptych
