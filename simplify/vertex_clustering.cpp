#include "simplify/vertex_clustering.hpp"

#include "simplify/cell_moves.hpp"
#include "simplify/color_charts.hpp"
#include "simplify/key_hash.hpp"
#include "simplify/sunk_points.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

/// A key of point indices or cells, and of materials where colours count.
template <size_t count>
using Key = std::array<uint32_t, count>;

double area_of(const Surface& surface, uint32_t a, uint32_t b, uint32_t c) {
  const glm::dvec3 origin(surface.points[a]);
  return glm::length(
             glm::cross(glm::dvec3(surface.points[b]) - origin, glm::dvec3(surface.points[c]) - origin)) /
         2;
}

/// What all clusterings of one surface share.
struct Source {
  const Surface& surface;
  std::span<const uint8_t> locked;
  Colors colors;
  TrianglePlanes planes;
  const LayeredPlanes& layered;
  std::vector<uint8_t> sunk;
};

class Clustering {
 public:
  /// Gives up as soon as more than `most` triangles are left.
  Clustering(const Source& source, double cell, size_t most = std::numeric_limits<size_t>::max())
      : surface_(source.surface), planes_(source.planes), colors_(source.colors), max_(most), cell_(cell) {
    CellMoves moves = move_to_cells(surface_, planes_, source.locked, cell, source.layered, source.sunk);
    image_ = std::move(moves.images);
    moved_ = moves.furthest;
    planes_left_ = moves.planes_left;
    bound_ = std::max(moved_, planes_left_);
    if (map_triangles() && keep_lines()) keep_points();
  }

  size_t triangles() const { return kept_.size(); }  ///< more than `most` if it gave up
  Clustered result() const {
    return {extract(surface_.points, kept_, colors_of_kept()), bound_, planes_left_};
  }

 private:
  bool map_triangles() {
    struct Image {
      double area;
      uint32_t triangle;
    };
    const size_t expected = std::min(max_, surface_.triangles.size());
    tsl::robin_map<Key<4>, uint32_t, KeyHash, KeyEqual> numbers(2 * expected);
    std::vector<Image> images;
    images.reserve(expected);
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const auto& vertices = surface_.triangles[i].vertices;
      Key<4> corners = {image_[vertices[0]], image_[vertices[1]], image_[vertices[2]],
                        color(surface_.triangles[i])};
      if (degenerate(surface_.points[corners[0]], surface_.points[corners[1]], surface_.points[corners[2]]))
        continue;
      std::sort(corners.begin(), corners.begin() + 3);
      const double area = planes_.area(i);
      const auto [found, inserted] = numbers.try_emplace(corners, static_cast<uint32_t>(images.size()));
      if (inserted) {
        images.push_back({area, i});
      } else if (Image& image = images[found->second]; area > image.area) {
        image = {area, i};
      }
      if (images.size() > max_) break;
    }
    kept_.reserve(images.size());
    sides_.reserve(3 * images.size());
    corners_.reserve(images.size());
    for (const Image& image : images) {
      Triangle triangle = surface_.triangles[image.triangle];
      for (uint32_t& vertex : triangle.vertices) vertex = image_[vertex];
      if (!keep(triangle, image.triangle)) return false;
    }
    return true;
  }

  /// Triangles that became lines: those lines that are no side of a kept triangle stay as thin triangles.
  bool keep_lines() {
    struct Candidate {
      double area = -1;
      Triangle triangle{};
      uint32_t source = 0;  ///< index of the one that it stands for
      bool moved = false;   ///< its corners are not those of a triangle of the surface
    };
    tsl::robin_map<Key<3>, Candidate, KeyHash, KeyEqual> lines;
    std::vector<Key<3>> order;
    for (uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      const Triangle& triangle = surface_.triangles[t];
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
        // Three different points on a line: rare; the triangle itself may stay in its place.
        bound_ = std::max(bound_, 2 * moved_);
        if (!keep(triangle, t)) return false;
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
          // The winding of the triangle that it replaces: r and q keep their places, p takes the third.
          Triangle thin = triangle;
          thin.vertices[single] = q;
          thin.vertices[(single + i) % 3] = r;
          thin.vertices[(single + 3 - i) % 3] = p;
          found.value() = {area, thin, t, true};
        }
      }
      if (const double area = planes_.area(t); !found->second.moved && area > found->second.area) {
        found.value() = {area, triangle, t, false};
      }
    }
    for (const Key<3>& key : order) {
      if (sides_.contains(key)) continue;
      const Candidate& candidate = lines.at(key);
      if (!candidate.moved) bound_ = std::max(bound_, 2 * moved_);
      if (!keep(candidate.triangle, candidate.source)) return false;
    }
    return true;
  }

  /// Triangles that became points: where no kept triangle has the point for a corner, the largest of them
  /// stays.
  void keep_points() {
    tsl::robin_map<Key<2>, std::pair<double, uint32_t>, KeyHash, KeyEqual> points;
    std::vector<Key<2>> order;
    for (uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      const Triangle& triangle = surface_.triangles[t];
      const auto& [a, b, c] = triangle.vertices;
      const Key<2> key = {image_[a], color(triangle)};
      if (image_[a] != image_[b] || image_[b] != image_[c] || corners_.contains(key)) continue;
      const double area = planes_.area(t);
      const auto [found, inserted] = points.try_emplace(key, area, t);
      if (inserted) {
        order.push_back(key);
      } else if (area > found->second.first) {
        found.value() = {area, t};
      }
    }
    for (const Key<2>& point : order) {
      bound_ = std::max(bound_, std::min(2 * moved_, std::sqrt(3.0) * cell_));
      const uint32_t source = points.at(point).second;
      if (!keep(surface_.triangles[source], source)) return;
    }
  }

  static Key<3> side(uint32_t a, uint32_t b, uint32_t color) {
    return {std::min(a, b), std::max(a, b), color};
  }
  /// What lies on others must not be taken for them.
  uint32_t color(const Triangle& triangle) const {
    return colors_ == Colors::keep || layer_of(triangle.material) > 0 ? triangle.material : 0;
  }

  /// source: index of the triangle that it comes from, corner by corner.
  bool keep(const Triangle& triangle, uint32_t source) {
    kept_.push_back(triangle);
    if (!surface_.colors.empty()) sources_.push_back(source);
    if (kept_.size() > max_) return false;
    const auto& [a, b, c] = triangle.vertices;
    const uint32_t own = color(triangle);
    for (const uint32_t corner : {a, b, c}) corners_.insert({corner, own});
    for (const Key<3>& line : {side(a, b, own), side(b, c, own), side(c, a, own)}) sides_.insert(line);
    return true;
  }

  /// Corners keep their places on textures, which so move as far as they do, and their colours and baked
  /// light; where those of the point that they moved to are not distinct, they get them, so that they meet
  /// there in one.
  std::vector<SurfaceCorners> colors_of_kept() const {
    std::vector<SurfaceCorners> colors;
    if (surface_.colors.empty()) return colors;
    std::vector<SurfaceCorner> of_points(surface_.points.size());
    for (size_t t = surface_.triangles.size(); t-- > 0;) {
      for (size_t k = 0; k < 3; ++k) of_points[surface_.triangles[t].vertices[k]] = surface_.colors[t][k];
    }
    for (size_t i = 0; i < kept_.size(); ++i) {
      SurfaceCorners& own = colors.emplace_back(surface_.colors[sources_[i]]);
      for (size_t k = 0; k < 3; ++k) {
        const SurfaceCorner& there = of_points[kept_[i].vertices[k]];
        if (color_difference(own[k].color, there.color) < distinct_colors) own[k].color = there.color;
        if (light_difference(own[k].light, there.light) < distinct_colors) own[k].light = there.light;
      }
    }
    return colors;
  }

  const Surface& surface_;
  const TrianglePlanes& planes_;
  Colors colors_;
  size_t max_;
  double cell_, moved_ = 0, bound_ = 0, planes_left_ = 0;
  std::vector<uint32_t> image_;
  std::vector<Triangle> kept_;
  std::vector<uint32_t> sources_;  ///< for each kept triangle, where corners have colours
  tsl::robin_set<Key<2>, KeyHash, KeyEqual> corners_;
  tsl::robin_set<Key<3>, KeyHash, KeyEqual> sides_;
};

Source source_of(const Surface& surface, std::span<const uint8_t> locked, Colors colors,
                 const LayeredPlanes& layered) {
  return {surface, locked, colors, TrianglePlanes(surface), layered, sunk_points(surface)};
}

}  // namespace

Clustered cluster_vertices(const Surface& surface, std::span<const uint8_t> locked, double cell,
                           Colors colors, const LayeredPlanes& layered) {
  return Clustering(source_of(surface, locked, colors, layered), cell).result();
}

bool clusters_within(const Surface& surface, std::span<const uint8_t> locked, double cell, size_t triangles,
                     Colors colors, const LayeredPlanes& layered) {
  return Clustering(source_of(surface, locked, colors, layered), cell, triangles).triangles() <= triangles;
}

Clustered cluster_to(const Surface& surface, std::span<const uint8_t> locked, size_t triangles, Colors colors,
                     const LayeredPlanes& layered) {
  const Source source = source_of(surface, locked, colors, layered);
  const LatticeBox box = surface.box();
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo);
  const double longest = std::max({size.x, size.y, size.z, 1.0});
  // At the coarse end one cell holds everything; at the fine end hardly any two points share a cell.
  double coarse = longest * 1.001,
         fine = std::max(1.0, longest / (8 * std::sqrt(static_cast<double>(triangles)) + 8));
  std::optional<Clustering> best;
  for (int i = 0; i < 9 && coarse > 1.1 * fine; ++i) {
    const double cell = std::sqrt(coarse * fine);
    Clustering clustering(source, cell, triangles);
    const size_t count = clustering.triangles();
    if (count <= triangles) {
      best.emplace(std::move(clustering));
      coarse = cell;
      // Near enough to the number that was asked for.
      if (count * 5 >= triangles * 4) break;
    } else {
      fine = cell;
    }
  }
  return best ? best->result() : Clustering(source, coarse).result();
}

}  // namespace triptych
