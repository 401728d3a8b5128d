// The surface where a field changes its sign, as a closed, manifold, indexed mesh: marching tetrahedra on
// the Kuhn subdivision of a grid of cubes (Doi and Koide 1991), slice by slice.
#pragma once

#include "samples/surfaces/noise.hpp"
#include "samples/surfaces/ply_writer.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>

namespace triptych {

/// Negative inside. Threads call it side by side.
class Field {
 public:
  virtual ~Field() = default;
  /// Sets each value. Values of one sign may be wrong in size where no sample beside them has the other.
  virtual void evaluate(const SampleRow& row, std::span<float> values) const = 0;
};

struct CubeGrid {
  glm::dvec3 low{0};
  double step = 1;
  std::array<size_t, 3> points{2, 2, 2};  ///< along x, y, z; at least 2 each

  /// Covers the box: exactly along its longest side, which gets `cells` cubes, and at least along the others.
  static CubeGrid over(const glm::dvec3& low, const glm::dvec3& high, size_t cells);
  glm::dvec3 high() const;
};

/// Makes the surface of the field over the grid; triangles look outwards, and vertices are shared. Each
/// edge has two triangles, but for those on the grid's box, which have one. No two vertices coincide.
/// Memory: 22 bytes for each point of a slice across y, and what one slice has of the surface. The result
/// does not depend on the number of threads.
void polygonise(const Field& field, const CubeGrid& grid, PlyWriter& writer);

/// About how many triangles polygonise makes, from at least `rows` of the grid's rows of cubes, spread
/// evenly, or from all if there are no more.
double estimate_triangles(const Field& field, const CubeGrid& grid, size_t rows);

/// A field that may leave out details smaller than the grid's step can show.
using FieldMaker = std::function<std::unique_ptr<Field>(double step)>;

struct SurfaceReport {
  uint64_t vertices = 0, triangles = 0;
  glm::dvec3 low{0}, high{0};  ///< of the grid
};

/// Writes `scene.ply` into the folder, which it makes, with about `triangles` triangles: searches for the
/// grid over the box whose estimate is nearest.
SurfaceReport write_surface(const FieldMaker& make_field, const glm::dvec3& low, const glm::dvec3& high,
                            uint64_t triangles, const std::filesystem::path& folder, const std::string& name);

}  // namespace triptych
