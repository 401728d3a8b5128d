// What lies over a place on a placed part, by rays through what stands around it.
#pragma once

#include "preprocess/covered/part_regions.hpp"
#include "preprocess/part_cache.hpp"
#include "preprocess/part_space.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace triptych {

/// What covers a place or a region, and how near it comes; in the hierarchy's space.
struct RegionCover {
  uint32_t placed = 0;
  double clearance = 0;
};

/// The regions of a placed part, in the space of its hierarchy.
struct PlacedRegions : PartSpace {
  PlacedRegions(const Parts& parts, const PlacedParts& hierarchy, uint32_t index,
                PartCache<PartRegions>& cache)
      : PartSpace(hierarchy, index),
        number(index),
        outside(parts.parts[hierarchy.placed[index].part].outside),
        turns_over((glm::determinant(glm::dmat3(transform)) < 0) != (outside == Outside::back)),
        regions(cache.get(hierarchy.placed[index].part)) {}

  std::array<glm::dvec3, 3> corners(uint32_t triangle) const {
    std::array<glm::dvec3, 3> result;
    for (size_t k = 0; k < 3; ++k) result[k] = out(regions->points[regions->triangles[triangle][k]]);
    return result;
  }

  uint32_t number;
  Outside outside;
  bool turns_over;  ///< triangles go round clockwise where they look out, or may do so
  std::shared_ptr<const PartRegions> regions;
};

class Surroundings {
 public:
  /// others: the placed parts around this one, itself among them, with their boxes; transparent ones cover
  /// nothing. They are loaded where a ray comes near. tolerance: up to it surfaces touch.
  Surroundings(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartRegions>& cache,
               uint32_t placed, const std::vector<std::pair<uint32_t, Box>>& others, double tolerance);

  const PlacedRegions& own() const { return own_; }

  /// Of `others` those that have triangles whose boxes reach into `near`, or into `inside`, if they are
  /// bodies that reach into `near`, and itself: a part of others, in their order.
  std::vector<uint32_t> reaching(const Box& near, const Box& inside);

  /// What a ray from a place of the region along `way`, of length 1, first meets within a sixteenth of
  /// `whole`, or the body that the place lies in, if the ray leaves it within `whole`.
  std::optional<RegionCover> over(uint32_t region, const glm::dvec3& from, const glm::dvec3& way,
                                  double whole);
  /// Whether rays that rise by a quarter of their length meet something, too.
  bool hidden_from_sides(uint32_t region, const glm::dvec3& from, const glm::dvec3& normal, double whole);

 private:
  struct Other {
    uint32_t number;
    Box box;
    bool is_body;  ///< it encloses bodies, and all of its mesh is in it
    std::optional<PlacedRegions> placed = {};
    std::optional<uint32_t> last = {};  ///< the triangle that a ray met last, which the next may meet, too
  };
  struct First {
    double along;
    uint32_t placed, triangle;
    bool leaves;
  };
  const PlacedRegions& placed(Other& other);
  /// The nearest of `first` and what the ray meets of the other one up to `reach`; at one distance what is of
  /// the earlier one, and of its triangles the first, whatever was met before.
  void look(Other& other, uint32_t region, const glm::dvec3& from, const glm::dvec3& way, double reach,
            std::optional<First>& first);

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartRegions>& cache_;
  double tolerance_;
  PlacedRegions own_;
  std::vector<Other> others_;
};

}  // namespace triptych
