#include "measure/difference/shape_change.hpp"

#include "measure/difference/facet_index.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <set>

namespace triptych {

namespace {

using Facet = PlacedShape::Facet;

/// Motions are found from one triangle: what is further from it than so many of its shortest edges would be
/// off by more than facets are looked for within.
constexpr double furthest_edges = 15;
/// Triangles of the other shape that are tried.
constexpr size_t most_candidates = 64;

glm::dvec3 centre_of(const Facet& facet) {
  return (facet.corners[0] + facet.corners[1] + facet.corners[2]) / 3.0;
}

std::array<double, 3> edges_of(const Facet& facet) {
  std::array<double, 3> edges;
  for (size_t k = 0; k < 3; ++k) edges[k] = glm::distance(facet.corners[k], facet.corners[(k + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  return edges;
}

double double_area(const Facet& facet) {
  return glm::length(glm::cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]));
}

/// Of the shape's surface.
glm::dvec3 centre_of(const PlacedShape& shape) {
  glm::dvec3 sum(0);
  double area = 0;
  for (const Facet& facet : shape.facets) {
    sum += double_area(facet) * (centre_of(facet) - shape.box.lo);  // small numbers
    area += double_area(facet);
  }
  return area > 0 ? shape.box.lo + sum / area : center(shape.box);
}

/// What no motion changes: a triangle's edges, ascending, and how far it is from the middle of its shape.
using Mark = std::array<double, 4>;
Mark mark_of(const Facet& facet, const glm::dvec3& middle) {
  const std::array<double, 3> edges = edges_of(facet);
  return {edges[0], edges[1], edges[2], glm::distance(centre_of(facet), middle)};
}

/// Whether a triangle is so many tolerances thick. Thinner than 8, it may have lost its area on a lattice.
bool is_thick(const Facet& facet, double tolerance, double tolerances = 8) {
  return double_area(facet) > tolerances * tolerance * edges_of(facet)[2];
}
bool may_vanish(const Facet& facet, double tolerance) { return !is_thick(facet, tolerance); }

/// How many triangles are surely there, and how many may be.
std::pair<size_t, size_t> counts_of(const PlacedShape& shape, double tolerance) {
  std::pair<size_t, size_t> counts{0, 0};
  for (const Facet& facet : shape.facets) {
    counts.first += is_thick(facet, tolerance, 16);
    counts.second += is_thick(facet, tolerance, 4);
  }
  return counts;
}

Facet placed(const Facet& facet, const Affine& motion) {
  Facet moved = facet;
  for (glm::dvec3& corner : moved.corners) corner = motion * glm::dvec4(corner, 1);
  return moved;
}

/// Of a rotation and a translation.
Affine inverse(const Affine& motion) {
  const glm::dmat3 back = glm::transpose(glm::dmat3(motion));
  return {back[0], back[1], back[2], -(back * motion[3])};
}

/// Both shapes with their triangles by place.
class Comparison {
 public:
  Comparison(const PlacedShape& before, const PlacedShape& after)
      : before_(before),
        after_(after),
        tolerance_(std::max(before.tolerance + after.tolerance, 1e-300)),
        before_index_(before, tolerance_ * slack(furthest_edges)),
        after_index_(after, tolerance_ * slack(furthest_edges)) {
    // As many of each: what is doubled is found in its place, too.
    const auto [before_least, before_most] = counts_of(before, tolerance_);
    const auto [after_least, after_most] = counts_of(after, tolerance_);
    as_many_ = before_least <= after_most && after_least <= before_most;
  }

  /// What is the same under the motion, which is off by `slack` tolerances at most.
  FacetMatch under(const Affine& motion, double slack) const {
    if (!as_many_) return FacetMatch::none;
    const double tolerance = tolerance_ * slack;
    const FacetMatch there = all_in(before_.facets, motion, after_index_, tolerance);
    if (there == FacetMatch::none) return there;
    return std::min(there, all_in(after_.facets, inverse(motion), before_index_, tolerance));
  }

  /// A motion that maps one to the other, with what is the same then.
  std::optional<std::pair<Affine, FacetMatch>> motion() const {
    Affine move(1);
    move[3] = after_.box.lo - before_.box.lo;
    if (const FacetMatch match = under(move, 2); match != FacetMatch::none) return std::pair(move, match);
    const glm::dvec3 middle = centre_of(before_), other_middle = centre_of(after_);
    const std::optional<Facet> landmark = find_landmark(middle);
    if (!landmark) return std::nullopt;
    const Mark mark = mark_of(*landmark, middle);
    const double slack_here = slack(diagonal(before_.box) / mark[0]);
    size_t candidates = 0;
    for (const Facet& other : after_.facets) {
      const Mark others = mark_of(other, other_middle);
      bool alike = true;
      for (size_t k = 0; k < mark.size(); ++k)
        alike = alike && std::abs(mark[k] - others[k]) <= 4 * tolerance_;
      if (!alike) continue;
      if (++candidates > most_candidates) break;
      for (const auto& turned : turns_between(*landmark, other)) {
        if (const FacetMatch match = under(turned, slack_here); match != FacetMatch::none)
          return std::pair(turned, match);
      }
    }
    return std::nullopt;
  }

 private:
  static double slack(double edges) { return 2 + 4 * edges; }

  /// The least match of the facets, once the motion has placed them.
  FacetMatch all_in(const std::vector<Facet>& facets, const Affine& motion, const FacetIndex& index,
                    double tolerance) const {
    FacetMatch least = FacetMatch::shape_and_colors;
    bool any = false;
    for (const Facet& facet : facets) {
      const FacetMatch match = index.find(placed(facet, motion), tolerance);
      if (match == FacetMatch::none && may_vanish(facet, tolerance_)) continue;
      least = std::min(least, match);
      if (least == FacetMatch::none) break;
      any = true;
    }
    return any ? least : FacetMatch::none;
  }

  /// A triangle to recognise the shape by: of those that fewest others are like, the largest.
  std::optional<Facet> find_landmark(const glm::dvec3& middle) const {
    const double shortest = diagonal(before_.box) / furthest_edges;
    std::map<std::array<int64_t, 4>, std::pair<size_t, const Facet*>> kinds;
    for (const Facet& facet : before_.facets) {
      const Mark mark = mark_of(facet, middle);
      if (!(mark[0] >= shortest) || may_vanish(facet, tolerance_)) continue;
      std::array<int64_t, 4> key;
      for (size_t k = 0; k < key.size(); ++k) key[k] = std::llround(mark[k] / (16 * tolerance_));
      auto& [count, largest] = kinds[key];
      ++count;
      if (!largest || double_area(facet) > double_area(*largest)) largest = &facet;
    }
    const Facet* best = nullptr;
    size_t fewest = 0;
    for (const auto& [key, kind] : kinds) {
      const auto& [count, largest] = kind;
      if (best && (count > fewest || (count == fewest && double_area(*largest) <= double_area(*best))))
        continue;
      best = largest;
      fewest = count;
    }
    return best ? std::optional(*best) : std::nullopt;
  }

  /// Rotations and translations that map one triangle to the other.
  std::vector<Affine> turns_between(const Facet& from, const Facet& to) const {
    std::vector<Affine> turns;
    std::array<size_t, 3> order = {0, 1, 2};
    do {
      bool alike = true;
      for (size_t k = 0; k < 3; ++k) {
        const size_t next = (k + 1) % 3;
        const double length = glm::distance(from.corners[k], from.corners[next]);
        const double other = glm::distance(to.corners[order[k]], to.corners[order[next]]);
        alike = alike && std::abs(length - other) <= 4 * tolerance_;
      }
      if (!alike) continue;
      const glm::dmat3 turn = frame(to.corners[order[0]], to.corners[order[1]], to.corners[order[2]]) *
                              glm::transpose(frame(from.corners[0], from.corners[1], from.corners[2]));
      turns.emplace_back(turn[0], turn[1], turn[2], to.corners[order[0]] - turn * from.corners[0]);
    } while (std::next_permutation(order.begin(), order.end()));
    return turns;
  }

  static glm::dmat3 frame(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 along = glm::normalize(b - a);
    const glm::dvec3 normal = glm::normalize(glm::cross(along, c - a));
    return {along, glm::cross(normal, along), normal};
  }

  const PlacedShape& before_;
  const PlacedShape& after_;
  bool as_many_ = true;
  double tolerance_;
  FacetIndex before_index_, after_index_;
};

std::set<VertexColor> colors_of(const PlacedShape& shape) {
  std::set<VertexColor> colors;
  for (const Facet& facet : shape.facets) colors.insert(facet.colors.begin(), facet.colors.end());
  return colors;
}

double degrees_of(const Affine& motion) {
  const double cosine = (motion[0][0] + motion[1][1] + motion[2][2] - 1) / 2;
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.14159265358979323846;
}

}  // namespace

ShapeChange compare_shapes(const PlacedShape& before, const PlacedShape& after) {
  ShapeChange change;
  if (before.facets.empty() || after.facets.empty()) {
    change.reshaped = before.facets.size() != after.facets.size();
    return change;
  }
  const Comparison comparison(before, after);
  if (const FacetMatch match = comparison.under(Affine(1), 1); match != FacetMatch::none) {
    change.recolored = match == FacetMatch::shape;
    return change;
  }
  if (const auto motion = comparison.motion()) {
    change.moved = true;
    change.recolored = motion->second == FacetMatch::shape;
    const glm::dvec3 middle = center(before.box);
    change.offset = motion->first * glm::dvec4(middle, 1) - middle;
    change.turned = degrees_of(motion->first);
    return change;
  }
  change.reshaped = true;
  change.recolored = colors_of(before) != colors_of(after);
  return change;
}

}  // namespace triptych
