#include "preprocess/layers/find_layers.hpp"

#include "base/threads.hpp"
#include "preprocess/contacts/find_contacts.hpp"
#include "preprocess/larger_boxes.hpp"
#include "preprocess/part_space.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

using FlatTriangle = std::array<glm::dvec2, 3>;

constexpr double about_parallel = 0.999;  ///< cosine

/// A placed part and its facets.
struct Placed : PartSpace {
  Placed(const Parts& parts, const PlacedParts& hierarchy, uint32_t index, PartCache<PartFacets>& cache)
      : PartSpace(hierarchy, index),
        part(hierarchy.placed[index].part),
        instance(hierarchy.placed[index].instance),
        rounding(PartFacets::flat_steps * parts.lattices[parts.parts[part].lattice].step *
                 hierarchy.stretches[hierarchy.placed[index].transform]),
        facets(cache.get(part)) {}

  uint32_t part, instance;
  double rounding;  ///< what a facet's points may be off its plane
  std::shared_ptr<const PartFacets> facets;
};

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Whether a side of `a` separates the triangles, or leaves an overlap of at most `margin`.
bool separates(const FlatTriangle& a, const FlatTriangle& b, double margin) {
  const double turn = cross(a[1] - a[0], a[2] - a[0]) < 0 ? -1 : 1;
  for (size_t k = 0; k < 3; ++k) {
    const glm::dvec2 side = a[(k + 1) % 3] - a[k];
    const double length = std::hypot(side.x, side.y);
    double deepest = -1;
    for (const glm::dvec2& corner : b) deepest = std::max(deepest, turn * cross(side, corner - a[k]));
    if (deepest <= margin * length) return true;
  }
  return false;
}

/// The plane that facets are compared in: two axes.
struct PlaneAxes {
  explicit PlaneAxes(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 least = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                             : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                  : glm::dvec3(0, 0, 1);
    u = glm::normalize(glm::cross(normal, least));
    v = glm::cross(normal, u);
  }
  FlatTriangle of(const Placed& placed, const std::array<uint32_t, 3>& triangle) const {
    FlatTriangle flat;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 at = placed.out(placed.facets->points[triangle[k]]);
      flat[k] = {glm::dot(at, u), glm::dot(at, v)};
    }
    return flat;
  }
  glm::dvec3 u, v;
};

bool lies_in_plane(const Placed& of, const Facet& facet, const glm::dvec3& point, const glm::dvec3& normal,
                   double tolerance) {
  for (uint32_t i = facet.first; i < facet.first + facet.count; ++i) {
    for (const uint32_t corner : of.facets->triangles[i]) {
      if (std::abs(glm::dot(of.out(of.facets->points[corner]) - point, normal)) > tolerance) return false;
    }
  }
  return true;
}

/// The facets' triangles, those that reach into `both`.
std::vector<FlatTriangle> flat_triangles(const Placed& of, const Facet& facet, const PlaneAxes& axes,
                                         const Box& both) {
  std::vector<FlatTriangle> triangles;
  for (uint32_t i = facet.first; i < facet.first + facet.count; ++i) {
    Box box;
    for (const uint32_t corner : of.facets->triangles[i]) box.extend(of.out(of.facets->points[corner]));
    if (overlap(box, both)) triangles.push_back(axes.of(of, of.facets->triangles[i]));
  }
  return triangles;
}

bool facets_overlap(const Placed& a, const Facet& of_a, const Placed& b, const Facet& of_b,
                    double tolerance) {
  const glm::dvec3 normal_a = a.normal_out(of_a.normal), normal_b = b.normal_out(of_b.normal);
  const double cosine = glm::dot(normal_a, normal_b);
  if (std::abs(cosine) < about_parallel || (cosine < 0 && of_a.is_outward && of_b.is_outward)) return false;
  const double flat = tolerance + a.rounding + b.rounding;
  const bool a_is_larger = of_a.area > of_b.area;
  const bool same_plane = a_is_larger ? lies_in_plane(b, of_b, a.out(of_a.point), normal_a, flat)
                                      : lies_in_plane(a, of_a, b.out(of_b.point), normal_b, flat);
  if (!same_plane) return false;
  const Box box_a = grown(a.out(of_a.box), tolerance), box_b = grown(b.out(of_b.box), tolerance);
  const Box both{glm::max(box_a.lo, box_b.lo), glm::min(box_a.hi, box_b.hi)};
  const PlaneAxes axes(a_is_larger ? normal_a : normal_b);
  const std::vector<FlatTriangle> in_a = flat_triangles(a, of_a, axes, both),
                                  in_b = flat_triangles(b, of_b, axes, both);
  return std::any_of(in_a.begin(), in_a.end(), [&](const FlatTriangle& first) {
    return std::any_of(in_b.begin(), in_b.end(), [&](const FlatTriangle& second) {
      return !separates(first, second, tolerance) && !separates(second, first, tolerance);
    });
  });
}

class LayerFinder {
 public:
  LayerFinder(const Parts& parts, const PlacedParts& hierarchy, PartCache<PartFacets>& cache)
      : parts_(parts),
        hierarchy_(hierarchy),
        cache_(cache),
        tolerance_(contact_steps * parts.lattices[hierarchy.lattice].step) {
    const Lattice& lattice = parts.lattices[hierarchy.lattice];
    uint32_t instances = 0;
    for (const PlacedPart& placed : hierarchy.placed) instances = std::max(instances, placed.instance + 1);
    members_.resize(instances);
    tsl::robin_set<uint32_t> seen;
    for (size_t i = 0; i < hierarchy.placed.size(); ++i) {
      boxes_.push_back(grown(lattice.box(hierarchy.boxes[i]), tolerance_));
      members_[hierarchy.placed[i].instance].push_back(static_cast<uint32_t>(i));
      is_first_.push_back(seen.insert(hierarchy.placed[i].part).second);
    }
  }

  std::vector<FacetOverlap> run(uint64_t& crowded) {
    constexpr size_t most_tried = 1024, at_once = 1024;
    const LargerBoxes larger_boxes(boxes_);
    std::atomic<uint64_t> left_out = 0;
    std::vector<FacetOverlap> found;
    for (size_t first = 0; first < boxes_.size(); first += at_once) {
      std::vector<std::vector<FacetOverlap>> batch(std::min(at_once, boxes_.size() - first));
      parallel_for(batch.size(), [&](size_t index) {
        const auto number = static_cast<uint32_t>(first + index);
        size_t tried = 0;
        if (is_first_[number]) within(number, batch[index]);
        larger_boxes.visit(number, [&](uint32_t larger) {
          if (tried++ == most_tried) {
            ++left_out;
            return false;
          }
          if (may_differ(number, larger)) between(number, larger, batch[index]);
          return true;
        });
      });
      for (const auto& overlaps : batch) found.insert(found.end(), overlaps.begin(), overlaps.end());
    }
    crowded += left_out;
    return found;
  }

 private:
  uint32_t color_of(uint32_t placed) const { return parts_.parts[hierarchy_.placed[placed].part].color; }
  bool may_differ(uint32_t a, uint32_t b) const { return color_of(a) == no_id || color_of(a) != color_of(b); }
  Placed placed(uint32_t number) const { return Placed(parts_, hierarchy_, number, cache_); }
  bool is_too_small(const Facet& facet) const {
    constexpr double least_diagonal = 8;  // what is smaller cannot be told from an edge
    return diagonal(facet.box) < least_diagonal * tolerance_;
  }

  PlacedFacet describe(const Placed& placed, uint32_t facet) const {
    const Facet& of = placed.facets->facets[facet];
    return {placed.part, facet, placed.instance, span_of(placed, of), of.area};
  }

  double span_of(const Placed& own, const Facet& facet) const {
    constexpr size_t many = 64;
    const std::vector<uint32_t>& members = members_[own.instance];
    if (members.size() > many) return std::numeric_limits<double>::infinity();
    const glm::dvec3 point = own.out(facet.point), normal = own.normal_out(facet.normal);
    double span = 0;
    for (const uint32_t member : members) {
      const Placed other = placed(member);
      for (const Facet& next : other.facets->facets) {
        if (std::abs(glm::dot(other.normal_out(next.normal), normal)) > about_parallel &&
            std::abs(glm::dot(other.out(next.point) - point, normal)) < tolerance_)
          span += next.area;
      }
    }
    return span;
  }

  void add(const Placed& a, uint32_t of_a, const Placed& b, uint32_t of_b,
           std::vector<FacetOverlap>& found) const {
    const Facet &facet_a = a.facets->facets[of_a], &facet_b = b.facets->facets[of_b];
    if (is_too_small(facet_a) || is_too_small(facet_b)) return;
    if (facets_overlap(a, facet_a, b, facet_b, tolerance_))
      found.push_back({describe(a, of_a), describe(b, of_b)});
  }

  void between(uint32_t first, uint32_t second, std::vector<FacetOverlap>& found) const {
    const Placed a = placed(first), b = placed(second);
    const Box both{glm::max(boxes_[first].lo, boxes_[second].lo),
                   glm::min(boxes_[first].hi, boxes_[second].hi)};
    a.facets->tree.visit(a.in(both), [&](uint32_t of_a) {
      const Facet& facet = a.facets->facets[of_a];
      b.facets->tree.visit(grown(b.in(a.out(facet.box)), tolerance_ * b.shrink), [&](uint32_t of_b) {
        const bool same = a.part == b.part && of_a == of_b;
        const uint32_t color = b.facets->facets[of_b].color;
        if (!same && (color == no_id || color != facet.color)) add(a, of_a, b, of_b, found);
      });
    });
  }

  /// Of a part that has several colours: between its own facets.
  void within(uint32_t number, std::vector<FacetOverlap>& found) const {
    if (color_of(number) != no_id) return;
    const Placed own = placed(number);
    for (uint32_t facet = 0; facet < own.facets->facets.size(); ++facet) {
      const Facet& of = own.facets->facets[facet];
      own.facets->tree.visit(grown(of.box, tolerance_ * own.shrink), [&](uint32_t other) {
        if (other < facet && own.facets->facets[other].color != of.color) add(own, facet, own, other, found);
      });
    }
  }

  const Parts& parts_;
  const PlacedParts& hierarchy_;
  PartCache<PartFacets>& cache_;
  double tolerance_;
  std::vector<Box> boxes_;                      ///< of placed parts
  std::vector<bool> is_first_;                  ///< placement of its part
  std::vector<std::vector<uint32_t>> members_;  ///< for each instance its placed parts
};

}  // namespace

std::vector<FacetOverlap> find_layers(const Parts& parts, const PlacedParts& hierarchy,
                                      PartCache<PartFacets>& facets, uint64_t& crowded) {
  return LayerFinder(parts, hierarchy, facets).run(crowded);
}

}  // namespace triptych
