// One edge collapse: where a point may go, and how far that takes the surface from its source.
#pragma once

#include "simplify/fan.hpp"
#include "simplify/layered_planes.hpp"
#include "simplify/star.hpp"
#include "simplify/star_colors.hpp"

#include <cstdint>
#include <utility>
#include <vector>

namespace triptych {

/// A point that moves to a neighbour, whose triangles then close the hole.
struct Collapse {
  uint32_t point = 0, target = 0;
  double error_before = 0;  ///< the largest of the star's triangles
  double bound = 0;         ///< the largest error of the triangles that it changes
  double cost = 0;          ///< to be compared with others'
  double planes_left = 0;   ///< the size of the largest layered plane that it leaves; the bound is no smaller
  /// For each spoke of the star the error of its triangle afterwards; negative: it is removed.
  std::vector<double> errors;
  /// Triangles beside the star that take over the points of a removed one, and the least error they must then
  /// have.
  std::vector<std::pair<uint32_t, double>> beside;
};

/// Finds collapses and does them. Each fan of the star gets its own bound, the best of these: for a closed
/// fan around the target, the heights of star and fan over each other; for an open one that ends at the
/// target and at p, the distance to the line from p to the target, plus heights; for any, the length of the
/// collapsed edge. All three hold for materials, borders and non-manifold edges as well.
///
/// Where corners have colours, a change of them counts as far as the point moves, if it is distinct, and in
/// proportion if it is less: features narrower than the bound, or fainter, may vanish. Where they have places
/// on a texture, it counts how far that moves over the surface. Seams of either stay, as lines between
/// materials do.
///
/// A point that leaves a layered plane, or lays a triangle into one, counts as far as what lies there is
/// large.
class Collapser {
 public:
  static constexpr uint32_t any = 0xffffffffu;
  /// The cost of a collapse is its bound plus this share of its edge's length: of collapses without an error
  /// (flat regions) the short ones come first, which keeps triangles well shaped.
  static constexpr double length_weight = 1e-4;

  /// For a mesh of this many points; their planes are kept by reference. sunk: sunk_points(). What shows goes
  /// there last.
  explicit Collapser(size_t points, const LayeredPlanes& planes = LayeredPlanes::none(),
                     std::vector<uint8_t> sunk = {})
      : planes_(planes), sunk_(std::move(sunk)), marks_(points, 0) {}

  /// Of the neighbours that the point may move to, the one nearest to the planes around it; valid until the
  /// next call; null if it must stay. With a target, only that one is considered.
  const Collapse* find(ShrinkingMesh& mesh, uint32_t point, uint32_t target = any);
  /// Applies the collapse of the last find().
  void apply(ShrinkingMesh& mesh);
  /// The star of the last find().
  const Star& star() const { return star_; }

 private:
  struct Choice {
    double estimate;
    uint32_t target;
  };

  struct Neighbour {
    uint32_t point;
    glm::dvec3 way;  ///< from the point to it
  };
  struct Normal {
    glm::dvec3 direction;  ///< of length 1; 0 without area
    double doubled_area;
  };
  struct Border {
    uint32_t first, last;
    double moved;  ///< squared distance of the point from the line between both; infinite if it does not lie
                   ///< between them
  };

  void add_neighbour(uint32_t corner, const glm::dvec3& way);
  void look_around(const ShrinkingMesh& mesh);
  void list_choices();
  bool try_target(ShrinkingMesh& mesh, uint32_t target);
  double planes_left(uint32_t target) const;
  bool joins_well(ShrinkingMesh& mesh, uint32_t target);
  bool all_fit(ShrinkingMesh& mesh, uint32_t target, uint32_t neighbour, uint32_t third) const;
  bool map_closed(const Star::Fan& fan, uint32_t target);
  bool map_open(const Star::Fan& fan, uint32_t target);
  void add_color_change(const Star::Fan& fan, uint32_t target);
  bool move_fan(ShrinkingMesh& mesh, const Star::Fan& fan, uint32_t target);
  bool cover(ShrinkingMesh& mesh, const Spoke& gone, uint32_t target, double error);

  const LayeredPlanes& planes_;
  std::vector<uint8_t> sunk_;  ///< for each point; empty if none is
  Star star_;
  StarColors colors_;  ///< if the mesh has any
  bool has_colors_ = false;
  std::vector<ProjectedStar> projected_;  ///< for each fan
  std::vector<uint8_t> projects_;         ///< 0: not yet known, 1: it does, 2: it does not
  ProjectedStar along_;
  /// Removed spokes that are not yet covered, and their errors.
  std::vector<std::pair<size_t, double>> pending_;
  std::vector<glm::dvec3> from_, to_;  ///< for each spoke its corners, relative to the point
  std::vector<Normal> normals_;        ///< for each spoke
  std::vector<double> before_;         ///< for each spoke its error
  std::vector<Choice> choices_;
  Collapse collapse_;  ///< the one that is tried, or was found
  glm::dvec3 way_{0};  ///< from the point to the target that is tried
  double length_ = 0;  ///< of it
  std::vector<glm::dvec3> ring_;
  std::vector<uint32_t> marks_;        ///< for each point the last star whose corner it was
  uint32_t mark_ = 0;                  ///< the mark of the current star; mark_ + 1 marks thirds_
  std::vector<uint32_t> thirds_;       ///< of the triangles between the point and the target
  std::vector<Neighbour> neighbours_;  ///< of the point, each once
  std::vector<Border> borders_;        ///< of its open fans
};

}  // namespace triptych
