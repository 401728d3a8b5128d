#include "lod/simplify/vertex_clustering.hpp"

#include "scene/key_hash.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

/// Point indices or cells, as a key; materials where colours count.
template <size_t count>
using Key = std::array<uint32_t, count>;

/// The sum of squared distances from planes, weighted, and from a point.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0;
  glm::dvec3 weighted_points{0};
  double weight = 0;

  void add_plane(const glm::dvec3& normal, double offset, double area) {
    xx += area * normal.x * normal.x, xy += area * normal.x * normal.y, xz += area * normal.x * normal.z;
    yy += area * normal.y * normal.y, yz += area * normal.y * normal.z, zz += area * normal.z * normal.z;
    x += area * normal.x * offset, y += area * normal.y * offset, z += area * normal.z * offset;
  }
  /// Up to a constant.
  double operator()(const glm::dvec3& p) const {
    const double planes = xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z +
                          2 * (xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z) +
                          2 * (x * p.x + y * p.y + z * p.z);
    // In flat cells every point fits; there the one in the middle is taken.
    const double middle = weight * glm::dot(p, p) - 2 * glm::dot(weighted_points, p);
    return planes + 0.01 * middle;
  }
};

double area_of(const Surface& surface, uint32_t a, uint32_t b, uint32_t c) {
  const glm::dvec3 origin(surface.points[a]);
  return glm::length(
             glm::cross(glm::dvec3(surface.points[b]) - origin, glm::dvec3(surface.points[c]) - origin)) /
         2;
}

class Clustering {
 public:
  Clustering(const Surface& surface, std::span<const uint8_t> locked, double cell, Colors colors)
      : surface_(surface), locked_(locked), cell_(cell), colors_(colors) {
    choose_representatives();
    map_triangles();
    keep_lines();
    keep_points();
  }

  Clustered result() const {
    Clustered clustered;
    clustered.piece = extract(surface_.points, kept_);
    clustered.bound = bound_;
    return clustered;
  }

 private:
  void choose_representatives() {
    const LatticeBox box = surface_.box();
    const glm::dvec3 lo(box.lo);
    tsl::robin_map<Key<3>, uint32_t, KeyHash> cells;
    std::vector<uint32_t> cell_of;
    cell_of.reserve(surface_.points.size());
    for (const glm::ivec3& point : surface_.points) {
      const glm::uvec3 at((glm::dvec3(point) - lo) / cell_);
      cell_of.push_back(
          cells.try_emplace({at.x, at.y, at.z}, static_cast<uint32_t>(cells.size())).first->second);
    }
    std::vector<Quadric> quadrics(cells.size());
    for (const Triangle& triangle : surface_.triangles) {
      std::array<glm::dvec3, 3> corners;
      for (size_t i = 0; i < 3; ++i) corners[i] = glm::dvec3(surface_.points[triangle.vertices[i]]) - lo;
      const glm::dvec3 doubled = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
      const double length = glm::length(doubled);
      for (size_t i = 0; i < 3; ++i) {
        Quadric& quadric = quadrics[cell_of[triangle.vertices[i]]];
        quadric.add_plane(doubled / length, -glm::dot(doubled / length, corners[0]), length);
        quadric.weighted_points += corners[i] * length;
        quadric.weight += length;
      }
    }
    std::vector<double> least(cells.size(), std::numeric_limits<double>::infinity());
    std::vector<uint32_t> best(cells.size(), 0);
    for (uint32_t i = 0; i < surface_.points.size(); ++i) {
      const double error = quadrics[cell_of[i]](glm::dvec3(surface_.points[i]) - lo);
      if (error < least[cell_of[i]] || !(least[cell_of[i]] < std::numeric_limits<double>::infinity())) {
        least[cell_of[i]] = error;
        best[cell_of[i]] = i;
      }
    }
    image_.resize(surface_.points.size());
    for (uint32_t i = 0; i < image_.size(); ++i) {
      image_[i] = !locked_.empty() && locked_[i] ? i : best[cell_of[i]];
      moved_ = std::max(
          moved_, glm::distance(glm::dvec3(surface_.points[i]), glm::dvec3(surface_.points[image_[i]])));
    }
    bound_ = moved_;
  }

  void map_triangles() {
    struct Source {
      double area;
      uint32_t index;
    };
    tsl::robin_map<Key<4>, Source, KeyHash> images;
    std::vector<Key<4>> order;
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const auto& vertices = surface_.triangles[i].vertices;
      Key<4> corners = {image_[vertices[0]], image_[vertices[1]], image_[vertices[2]],
                        color(surface_.triangles[i])};
      if (degenerate(surface_.points[corners[0]], surface_.points[corners[1]], surface_.points[corners[2]]))
        continue;
      std::sort(corners.begin(), corners.begin() + 3);
      const double area = area_of(surface_, vertices[0], vertices[1], vertices[2]);
      const auto [found, inserted] = images.try_emplace(corners, Source{area, i});
      if (inserted) {
        order.push_back(corners);
      } else if (area > found->second.area) {
        found.value() = {area, i};
      }
    }
    for (const auto& corners : order) {
      Triangle triangle = surface_.triangles[images.at(corners).index];
      for (uint32_t& vertex : triangle.vertices) vertex = image_[vertex];
      keep(triangle);
    }
  }

  /// Triangles that became lines: those lines that are no side of a kept triangle stay as thin triangles.
  void keep_lines() {
    struct Candidate {
      double area = -1;
      Triangle triangle{};
      bool moved = false;  ///< its corners are not those of a triangle of the surface
    };
    tsl::robin_map<Key<3>, Candidate, KeyHash> lines;
    std::vector<Key<3>> order;
    for (const Triangle& triangle : surface_.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      const std::array<uint32_t, 3> corners = {image_[a], image_[b], image_[c]};
      if (corners[0] == corners[1] && corners[1] == corners[2]) continue;
      const bool line_of_three =
          corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0];
      if (line_of_three && !degenerate(surface_.points[corners[0]], surface_.points[corners[1]],
                                       surface_.points[corners[2]])) {
        continue;
      }
      if (line_of_three) {
        // Three different points on a line: rare, and the triangle itself may stay for it.
        keep(triangle);
        bound_ = std::max(bound_, 2 * moved_);
        continue;
      }
      // Two corners went to p and one to q.
      size_t single = 0;
      while (corners[(single + 1) % 3] != corners[(single + 2) % 3]) ++single;
      const uint32_t q = corners[single], p = corners[(single + 1) % 3];
      const Key<3> key = side(p, q, color(triangle));
      if (sides_.contains(key)) continue;
      const auto [found, inserted] = lines.try_emplace(key);
      if (inserted) order.push_back(key);
      // With r, a corner that moved to p, the triangle p q r is no further from this one than its corners
      // moved.
      for (size_t i = 1; i < 3; ++i) {
        const uint32_t r = triangle.vertices[(single + i) % 3];
        if (r == p || degenerate(surface_.points[p], surface_.points[q], surface_.points[r])) continue;
        const double area = area_of(surface_, p, q, r);
        if (!found->second.moved || area > found->second.area) {
          // The turn of the triangle that it stands for: corner r keeps its place, q its own, p takes the
          // third.
          Triangle thin = triangle;
          thin.vertices[single] = q;
          thin.vertices[(single + i) % 3] = r;
          thin.vertices[(single + 3 - i) % 3] = p;
          found.value() = {area, thin, true};
        }
      }
      if (const double area = area_of(surface_, a, b, c); !found->second.moved && area > found->second.area) {
        found.value() = {area, triangle, false};
      }
    }
    for (const Key<3>& key : order) {
      if (sides_.contains(key)) continue;
      const Candidate& candidate = lines.at(key);
      if (!candidate.moved) bound_ = std::max(bound_, 2 * moved_);
      keep(candidate.triangle);
    }
  }

  /// Triangles that became points: where no kept triangle has the point for a corner, the largest of them
  /// stays.
  void keep_points() {
    tsl::robin_map<Key<2>, std::pair<double, Triangle>, KeyHash> points;
    std::vector<Key<2>> order;
    for (const Triangle& triangle : surface_.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      const Key<2> key = {image_[a], color(triangle)};
      if (image_[a] != image_[b] || image_[b] != image_[c] || corners_.contains(key)) continue;
      const double area = area_of(surface_, a, b, c);
      const auto [found, inserted] = points.try_emplace(key, area, triangle);
      if (inserted) {
        order.push_back(key);
      } else if (area > found->second.first) {
        found.value() = {area, triangle};
      }
    }
    for (const Key<2>& point : order) {
      bound_ = std::max(bound_, std::min(2 * moved_, std::sqrt(3.0) * cell_));
      keep(points.at(point).second);
    }
  }

  static Key<3> side(uint32_t a, uint32_t b, uint32_t color) {
    return {std::min(a, b), std::max(a, b), color};
  }
  uint32_t color(const Triangle& triangle) const { return colors_ == Colors::keep ? triangle.material : 0; }

  void keep(const Triangle& triangle) {
    kept_.push_back(triangle);
    const auto& [a, b, c] = triangle.vertices;
    const uint32_t own = color(triangle);
    for (const uint32_t corner : {a, b, c}) corners_.insert({corner, own});
    for (const Key<3>& line : {side(a, b, own), side(b, c, own), side(c, a, own)}) sides_.insert(line);
  }

  const Surface& surface_;
  std::span<const uint8_t> locked_;
  double cell_, moved_ = 0, bound_ = 0;
  std::vector<uint32_t> image_;
  std::vector<Triangle> kept_;
  Colors colors_;
  tsl::robin_set<Key<2>, KeyHash> corners_;
  tsl::robin_set<Key<3>, KeyHash> sides_;
};

}  // namespace

Clustered cluster_vertices(const Surface& surface, std::span<const uint8_t> locked, double cell,
                           Colors colors) {
  return Clustering(surface, locked, cell, colors).result();
}

Clustered cluster_to(const Surface& surface, std::span<const uint8_t> locked, size_t triangles,
                     Colors colors) {
  const LatticeBox box = surface.box();
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo);
  const double longest = std::max({size.x, size.y, size.z, 1.0});
  // One cell holds all at the coarse end; at the fine end hardly any two points meet.
  double coarse = longest * 1.001,
         fine = std::max(1.0, longest / (8 * std::sqrt(static_cast<double>(triangles)) + 8));
  std::optional<Clustered> best;
  for (int i = 0; i < 9 && coarse > 1.05 * fine; ++i) {
    const double cell = std::sqrt(coarse * fine);
    Clustered clustered = cluster_vertices(surface, locked, cell, colors);
    const size_t count = clustered.piece.surface.triangles.size();
    if (count <= triangles) {
      best = std::move(clustered);
      coarse = cell;
      // Near enough to what was asked for.
      if (count * 10 >= triangles * 9) break;
    } else {
      fine = cell;
    }
  }
  return best ? std::move(*best) : cluster_vertices(surface, locked, coarse, colors);
}

}  // namespace triptych
