#include "simplify/triangle_tree.hpp"

#include "simplify/median_split.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace triptych {

namespace {

double squared(const glm::dvec3& v) { return glm::dot(v, v); }

inline double squared_distance(const glm::dvec3& point, const Box& box) {
  return squared(glm::max(glm::max(box.lo - point, point - box.hi), glm::dvec3(0)));
}

/// The largest squared distance of the points from the triangle; cut short where it exceeds `limit`.
double furthest(std::span<const glm::dvec3> points, const Corners& triangle, double limit) {
  double largest = 0;
  for (const glm::dvec3& point : points) {
    largest = std::max(largest, squared(point - closest_point(point, triangle)));
    if (largest >= limit) break;
  }
  return largest;
}

double furthest(std::span<const glm::dvec3> points, const Box& box) {
  double largest = 0;
  for (const glm::dvec3& point : points) largest = std::max(largest, squared_distance(point, box));
  return largest;
}

/// False only where a point is further from the box than that: seen along each axis by itself.
bool may_be_within(const Box& points, const Box& box, double squared_distance) {
  const glm::dvec3 apart = glm::max(glm::max(box.lo - points.lo, points.hi - box.hi), glm::dvec3(0));
  return std::max({apart.x * apart.x, apart.y * apart.y, apart.z * apart.z}) < squared_distance;
}

double ratio(double a, double b) { return b > 0 ? std::clamp(a / b, 0.0, 1.0) : 0.0; }

}  // namespace

glm::dvec3 closest_point(const glm::dvec3& p, const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return a;
  const glm::dvec3 bp = p - b;
  const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return b;
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return a + ab * ratio(d1, d1 - d3);
  const glm::dvec3 cp = p - c;
  const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return c;
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return a + ac * ratio(d2, d2 - d6);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ratio(d4 - d3, (d4 - d3) + (d5 - d6));
  const double v = ratio(vb, va + vb + vc);
  return a + ab * v + ac * std::min(ratio(vc, va + vb + vc), 1 - v);
}

TriangleTree::TriangleTree(std::vector<Corners> triangles) : triangles_(std::move(triangles)) {
  order_.resize(triangles_.size());
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<glm::dvec3> centers;
  centers.reserve(triangles_.size());
  for (const auto& [a, b, c] : triangles_) centers.push_back(a + b + c);
  nodes_.reserve(triangles_.size());
  build(0, static_cast<uint32_t>(order_.size()), centers);
}

void TriangleTree::build(uint32_t first, uint32_t end, std::vector<glm::dvec3>& centers) {
  const auto index = nodes_.size();
  nodes_.emplace_back();
  Box box;
  for (uint32_t i = first; i < end; ++i) {
    for (const glm::dvec3& corner : triangles_[order_[i]]) box.extend(corner);
  }
  nodes_[index].box = box;
  if (end - first <= 3) {
    nodes_[index].first = first;
    nodes_[index].count = end - first;
    return;
  }
  const uint32_t middle = (first + end) / 2;
  split_at_median(std::span(order_).subspan(first, end - first), centers);
  build(first, middle, centers);
  nodes_[index].first = static_cast<uint32_t>(nodes_.size());
  build(middle, end, centers);
}

namespace {

/// An entry of the search's stack; the tree is split at medians, so its depth is at most 32.
struct Waiting {
  uint32_t node;
  double squared_distance;
};
using Stack = std::array<Waiting, 64>;

}  // namespace

TriangleTree::Nearest TriangleTree::nearest(const glm::dvec3& point, uint32_t hint,
                                            double squared_enough) const {
  Nearest best{squared(point - closest_point(point, triangles_[hint])), hint};
  if (best.squared_distance <= squared_enough) return best;
  Stack stack;
  size_t height = 0;
  stack[height++] = {0, triptych::squared_distance(point, nodes_[0].box)};
  while (height > 0) {
    const Waiting waiting = stack[--height];
    if (waiting.squared_distance >= best.squared_distance) continue;
    const Node& node = nodes_[waiting.node];
    if (node.count > 0) {
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const double distance = squared(point - closest_point(point, triangles_[order_[i]]));
        if (distance < best.squared_distance) best = {distance, order_[i]};
      }
      if (best.squared_distance <= squared_enough) return best;
    } else {
      const Waiting left{waiting.node + 1, triptych::squared_distance(point, nodes_[waiting.node + 1].box)};
      const Waiting right{node.first, triptych::squared_distance(point, nodes_[node.first].box)};
      const bool left_first = left.squared_distance <= right.squared_distance;
      stack[height++] = left_first ? right : left;
      stack[height++] = left_first ? left : right;
    }
  }
  return best;
}

TriangleTree::Nearest TriangleTree::within(std::span<const glm::dvec3> points,
                                           double squared_distance) const {
  Box around;
  for (const glm::dvec3& point : points) around.extend(point);
  const auto waiting_at = [&](uint32_t node) {
    const Box& box = nodes_[node].box;
    const bool may_be = may_be_within(around, box, squared_distance);
    return Waiting{node, may_be ? furthest(points, box) : squared_distance};
  };
  Stack stack;
  size_t height = 0;
  stack[height++] = waiting_at(0);
  while (height > 0) {
    const Waiting waiting = stack[--height];
    if (waiting.squared_distance >= squared_distance) continue;
    const Node& node = nodes_[waiting.node];
    if (node.count > 0) {
      for (uint32_t i = node.first; i < node.first + node.count; ++i) {
        const double distance = furthest(points, triangles_[order_[i]], squared_distance);
        if (distance < squared_distance) return {distance, order_[i]};
      }
    } else {
      const Waiting left = waiting_at(waiting.node + 1), right = waiting_at(node.first);
      const bool left_first = left.squared_distance <= right.squared_distance;
      stack[height++] = left_first ? right : left;
      stack[height++] = left_first ? left : right;
    }
  }
  return {squared_distance, no_triangle};
}

double TriangleTree::squared_distance(std::span<const glm::dvec3> points, uint32_t triangle) const {
  return furthest(points, triangles_[triangle], std::numeric_limits<double>::infinity());
}

}  // namespace triptych
