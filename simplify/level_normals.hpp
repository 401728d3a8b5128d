// Shading normals of levels of detail: those of the surface that they stand for, so that facets do not show
// that it does not have (Cohen, Olano and Manocha, Appearance-preserving simplification, 1998, keep them in a
// map; here corners have them).
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

class LevelNormals {
 public:
  /// The surface that levels are made of, which must outlive this.
  explicit LevelNormals(const Surface& source);

  /// Gives the level's triangles the normals that the source has at the points that their corners come from:
  /// the mean, by angle at the point (Thürmer and Wüthrich, Computing vertex normals from polygonal facets,
  /// 1998), of the corners or facets there that look the way of the triangle. A triangle that the source has,
  /// too, keeps what it has there. One that lies in facets of the source, or that differs by less than a
  /// degree, has none. level: sources are points of the source.
  void shade(Piece& level) const;

 private:
  /// A corner of a triangle of the source at a point.
  struct Corner {
    uint32_t triangle;
    uint8_t number;
    bool own;           ///< it has a normal of its own
    glm::vec3 normal;   ///< of unit length; 0 of a facet without area
    float angle;
  };
  std::span<const Corner> corners_at(uint32_t point) const {
    return std::span(corners_).subspan(first_[point], first_[point + 1] - first_[point]);
  }
  CornerNormals normals_of(const Piece& level, const Triangle& triangle) const;
  const Corner* find(const std::array<uint32_t, 3>& points) const;

  const Surface& source_;
  std::vector<uint32_t> first_;  ///< for each point its first corner; last, their count
  std::vector<Corner> corners_;
};

/// Of a source's triangles those whose normals differ from the facet's own by less than a degree lose them,
/// and those that look to the other side of the facet are turned. Where none is left the surface has none.
void drop_plain_normals(Surface& surface);

}  // namespace triptych
