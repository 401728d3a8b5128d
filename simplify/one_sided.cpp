#include "simplify/one_sided.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Lattice steps; smaller distances are not worth a cut: the bound may be this much larger than the true
/// distance.
constexpr double floor_distance = 0.25;

}  // namespace

double enough(double reached, double tightness) { return std::max(floor_distance, reached * tightness); }

void OneSided::reach(const glm::dvec3& point) {
  const auto nearest = tree_.nearest(point, hint_, lower_ * lower_);
  hint_ = nearest.triangle;
  lower_ = std::max(lower_, std::sqrt(nearest.squared_distance));
}

void OneSided::add(const Corners& triangle, double known) {
  ConvexPolygon polygon;
  for (const glm::dvec3& corner : triangle) polygon.push_back(corner);
  add(polygon, known);
}

double OneSided::finish(size_t max_cuts, double known, double most) {
  for (size_t i = 0; i < max_cuts && lower_ <= most && !waiting_.empty() &&
                     !is_tight(waiting_.front().bound) && !is_tight(known);
       ++i) {
    std::pop_heap(waiting_.begin(), waiting_.end());
    const Waiting piece = waiting_.back();
    waiting_.pop_back();
    divide(piece);
  }
  if (!waiting_.empty()) bound_ = std::max(bound_, waiting_.front().bound);
  return bound_;
}

void OneSided::add(const ConvexPolygon& polygon, double known) {
  if (polygon.size() < 3) return;
  // From the cheapest to the most expensive: one triangle may be near all corners, most likely the one that
  // was near the last piece, then the one near the middle; and no point is further away than by way of the
  // middle.
  double bound = known;
  const auto try_hint = [&] {
    if (!is_tight(bound)) bound = std::min(bound, std::sqrt(tree_.squared_distance(polygon, hint_)));
  };
  try_hint();
  if (!is_tight(bound)) {
    const glm::dvec3 middle = middle_of(polygon);
    double radius = 0;
    for (const glm::dvec3& corner : polygon) radius = std::max(radius, glm::distance(corner, middle));
    const auto nearest = tree_.nearest(middle, hint_);
    hint_ = nearest.triangle;
    lower_ = std::max(lower_, std::sqrt(nearest.squared_distance));
    bound = std::min(bound, std::sqrt(nearest.squared_distance) + radius);
    try_hint();
  }
  if (!is_tight(bound)) {
    const auto found = tree_.within(polygon, enough() * enough());
    if (found.triangle != TriangleTree::no_triangle) bound = std::sqrt(found.squared_distance);
  }
  if (is_tight(bound)) {
    bound_ = std::max(bound_, bound);
  } else {
    waiting_.push_back({bound, hint_, polygon});
    std::push_heap(waiting_.begin(), waiting_.end());
  }
}

/// Cuts out what lies over the triangle near its middle; halves the piece where that cuts off nothing.
void OneSided::divide(const Waiting& piece) {
  hint_ = piece.near;
  const Corners& near = tree_.triangle(piece.near);
  const glm::dvec3 normal = glm::cross(near[1] - near[0], near[2] - near[0]);
  const double slack = enough() * 0.3;
  std::array<ConvexPolygon, 3> beyond;
  ConvexPolygon rest = piece.polygon;
  bool was_cut = false;
  for (size_t i = 0; i < 3 && !rest.empty() && rest.size() < ConvexPolygon::max_corners; ++i) {
    const glm::dvec3 outwards = glm::cross(near[(i + 1) % 3] - near[i], normal);
    const double length = glm::length(outwards);
    if (!(length > 0)) continue;
    const glm::dvec3 direction = outwards / length;
    beyond[i] = cut(rest, direction, glm::dot(direction, near[i]) + slack, slack * 0.2);
    was_cut |= !beyond[i].empty();
  }
  if (rest.empty() || !was_cut) {
    halve(piece);
  } else {
    add(rest, piece.bound);
    for (const ConvexPolygon& part : beyond) add(part, piece.bound);
  }
}

void OneSided::halve(const Waiting& piece) {
  ConvexPolygon polygon = piece.polygon;
  double longest = -1;
  glm::dvec3 direction{0}, middle{0};
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 side = polygon[(i + 1) % polygon.size()] - polygon[i];
    if (glm::dot(side, side) <= longest) continue;
    longest = glm::dot(side, side);
    direction = side;
    middle = polygon[i] + side * 0.5;
  }
  const ConvexPolygon other = cut(polygon, direction, glm::dot(direction, middle), 0);
  add(polygon, piece.bound);
  add(other, piece.bound);
}

}  // namespace triptych
