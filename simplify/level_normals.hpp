// Shading normals of levels of detail: those of the surface that they stand for, so that facets do not show
// that it does not have (Cohen, Olano and Manocha, Appearance-preserving simplification, 1998, keep them in a
// map; here corners have them).
#pragma once

#include "simplify/surface.hpp"
#include "simplify/triangle_tree.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

class LevelNormals {
 public:
  /// Whether the facets of a source without normals are what it looks like, or a coarse level's, on which no
  /// normals are founded.
  enum class Facets : uint8_t { true_ones, coarse };
  /// The surface that levels are made of, which must outlive this.
  explicit LevelNormals(const Surface& source, Facets facets = Facets::true_ones);

  /// Gives the level's triangles the normals that the source has at the points that their corners come from:
  /// the mean, by angle at the point (Thürmer and Wüthrich, Computing vertex normals from polygonal facets,
  /// 1998), of the corners or facets there that look the way of the triangle. A triangle that the source has,
  /// too, keeps what it has there. One that lies in facets of the source, or that differs by less than a
  /// degree, has none. Nor have connected triangles, unless the source has normals of files there, that are
  /// narrower than twice `error` (lattice steps) on average, since where they are drawn they are a few pixels
  /// wide, or whose own normals are about as near to those that the source has beneath them. level: sources
  /// are points of the source.
  void shade(Piece& level, double error);

 private:
  /// A corner of a triangle of the source at a point.
  struct Corner {
    uint32_t triangle;
    uint8_t number;
    bool own;          ///< it has a normal of its own
    glm::vec3 normal;  ///< of unit length; 0 of a facet without area
    float angle;
  };
  using Normals = std::array<glm::vec3, 3>;
  /// What a triangle of a level may have.
  struct Choice {
    uint32_t triangle;
    Corners places;
    glm::vec3 facet;
    Normals normals;
    double area;  ///< twice
  };
  /// By how much normals of the source differ from those beside them.
  struct Differences {
    float facets = 0, normals = 0;
    int count = 0;
  };
  std::span<const Corner> corners_at(uint32_t point) const {
    return std::span(corners_).subspan(first_[point], first_[point + 1] - first_[point]);
  }
  std::optional<Choice> choose(Piece& level, uint32_t index) const;
  const Corner* find(const std::array<uint32_t, 3>& points) const;
  bool are_worth_it(std::span<const Choice> connected, double error);
  void compare(const Choice& choice, Differences& differences);
  glm::vec3 normal_at(uint32_t triangle, const glm::dvec3& point) const;

  const Surface& source_;
  Facets facets_;
  std::vector<uint32_t> first_;  ///< for each point its first corner; last, their count
  std::vector<Corner> corners_;
  std::optional<TriangleTree> tree_;  ///< of the source, once it is asked
};

/// Of a source's triangles those whose normals differ from the facet's own by less than a degree lose them,
/// and those that look to the other side of the facet are turned. Where none is left the surface has none.
void drop_plain_normals(Surface& surface);

}  // namespace triptych
