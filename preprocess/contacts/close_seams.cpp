#include "preprocess/contacts/close_seams.hpp"

#include "preprocess/contacts/near_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

/// Points of edges that one triangle has, ascending.
std::vector<uint32_t> open_points(const Surface& surface, const ClosedTriangles& closed) {
  std::vector<std::array<uint32_t, 2>> edges;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    if (closed.body_of[i] != no_id) continue;
    const auto& vertices = surface.triangles[i].vertices;
    for (size_t k = 0; k < 3; ++k) {
      const auto [lo, hi] = std::minmax(vertices[k], vertices[(k + 1) % 3]);
      edges.push_back({lo, hi});
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<uint32_t> points;
  for (size_t first = 0, end = 0; first < edges.size(); first = end) {
    while (end < edges.size() && edges[end] == edges[first]) ++end;
    if (end - first == 1) points.insert(points.end(), edges[first].begin(), edges[first].end());
  }
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

class SeamCloser {
 public:
  SeamCloser(Surface& surface, std::span<const uint32_t> open) : surface_(surface), open_(open) {}

  ClosedSeams run() {
    const NearPoints near(surface_.points, open_);
    std::vector<std::array<uint32_t, 2>> pairs;  // the later point, an earlier one
    for (const uint32_t point : open_) {
      near.visit(surface_.points[point], [&](uint32_t other) {
        if (other < point && distance(point, other) <= contact_steps) pairs.push_back({point, other});
      });
    }
    std::sort(pairs.begin(), pairs.end());
    if (pairs.empty()) return {};
    find_triangles(pairs);
    ClosedSeams closed;
    double furthest = 0;
    for (const auto& [point, other] : pairs) {
      if (gone_.contains(point) || gone_.contains(other) || !can_join(point, other)) continue;
      furthest = std::max(furthest, distance(point, other));
      join(point, other);
      ++closed.points;
    }
    if (closed.points == 0) return closed;
    closed.moved = static_cast<uint32_t>(std::ceil(furthest));
    surface_ = without_lone_points(surface_).surface;
    return closed;
  }

 private:
  glm::dvec3 at(uint32_t point) const { return glm::dvec3(surface_.points[point]); }
  double distance(uint32_t a, uint32_t b) const { return glm::distance(at(a), at(b)); }
  glm::dvec3 normal(const std::array<uint32_t, 3>& corners) const {
    return glm::cross(at(corners[1]) - at(corners[0]), at(corners[2]) - at(corners[0]));
  }

  void find_triangles(std::span<const std::array<uint32_t, 2>> pairs) {
    for (const auto& pair : pairs) {
      for (const uint32_t point : pair) triangles_at_[point];
    }
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      for (const uint32_t corner : surface_.triangles[i].vertices) {
        const auto found = triangles_at_.find(corner);
        if (found != triangles_at_.end()) found.value().push_back(i);
      }
    }
  }

  bool can_join(uint32_t point, uint32_t target) const {
    return std::ranges::all_of(triangles_at_.at(point), [&](uint32_t index) {
      std::array<uint32_t, 3> corners = surface_.triangles[index].vertices;
      const glm::dvec3 before = normal(corners);
      if (std::ranges::find(corners, target) != corners.end()) return false;
      std::ranges::replace(corners, point, target);
      return glm::dot(before, normal(corners)) > 0;
    });
  }

  void join(uint32_t point, uint32_t target) {
    std::vector<uint32_t> moved = std::exchange(triangles_at_[point], {});
    for (const uint32_t index : moved)
      std::ranges::replace(surface_.triangles[index].vertices, point, target);
    std::vector<uint32_t>& there = triangles_at_[target];
    there.insert(there.end(), moved.begin(), moved.end());
    gone_.insert(point);
  }

  Surface& surface_;
  std::span<const uint32_t> open_;
  tsl::robin_map<uint32_t, std::vector<uint32_t>> triangles_at_;  ///< of points that have others near
  tsl::robin_set<uint32_t> gone_;
};

}  // namespace

ClosedSeams close_seams(Surface& surface, const ClosedTriangles& closed) {
  return SeamCloser(surface, open_points(surface, closed)).run();
}

}  // namespace triptych
