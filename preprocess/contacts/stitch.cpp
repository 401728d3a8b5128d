#include "preprocess/contacts/stitch.hpp"

#include "preprocess/contacts/near_points.hpp"
#include "simplify/box_tree.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>
#include <utility>

namespace triptych {

namespace {

using Ends = std::array<uint32_t, 2>;

/// A held point on an edge between two others.
struct Divider {
  double share;  ///< of the way from the edge's first end to its second
  uint32_t point;
  bool operator<(const Divider& other) const {
    return share != other.share ? share < other.share : point < other.point;
  }
};

/// A triangle that is being divided, and the dividers of its edges, each from corner k to corner k + 1.
struct Divided {
  Triangle triangle;
  SurfaceCorners colors;
  CornerNormals normals;
  std::array<std::vector<Divider>, 3>
      dividers;  ///< in the order of their shares, which are of the whole edge
};

SurfaceCorner mixed(const SurfaceCorner& a, const SurfaceCorner& b, double share) {
  SurfaceCorner corner;
  for (size_t i = 0; i < corner.color.size(); ++i)
    corner.color[i] = static_cast<uint8_t>(std::lround(a.color[i] + (b.color[i] - a.color[i]) * share));
  for (size_t i = 0; has_light(a.light) && has_light(b.light) && i < corner.light.size(); ++i)
    corner.light[i] = static_cast<uint8_t>(std::lround(a.light[i] + (b.light[i] - a.light[i]) * share));
  if (!is_on_texture(a.coordinates) || !is_on_texture(b.coordinates)) return corner;
  const auto between = [&](double from, double to) {
    return static_cast<int32_t>(std::lround(from + (to - from) * share));
  };
  corner.coordinates = {between(a.coordinates.u, b.coordinates.u), between(a.coordinates.v, b.coordinates.v)};
  return corner;
}

VertexNormal mixed(const VertexNormal& a, const VertexNormal& b, double share) {
  if (!has_normal(a)) return {};
  return to_vertex_normal(glm::mix(glm::normalize(direction_of(a)), glm::normalize(direction_of(b)), share));
}

/// Values of triangles, or a value that stands for none.
template <typename Value>
Value of_triangle(const std::vector<Value>& values, size_t triangle) {
  return values.empty() ? Value{} : values[triangle];
}

class Stitcher {
 public:
  explicit Stitcher(Baked& baked) : baked_(baked), surface_(baked.surface) {
    for (uint32_t i = 0; i < baked.spans.size(); ++i) {
      if (is_held(i)) held_.push_back(i);
    }
  }

  double run() {
    if (held_.size() < 2) return 0;
    join_points();
    const double joined = std::sqrt(std::exchange(squared_moved_, 0));
    if (find_dividers()) divide_edges();
    if (joined_any_) drop_lone_points();
    return joined + std::sqrt(squared_moved_);
  }

 private:
  bool is_held(uint32_t point) const { return baked_.spans[point].first <= baked_.spans[point].last; }
  glm::dvec3 at(uint32_t point) const { return glm::dvec3(surface_.points[point]); }
  glm::dvec3 normal(const std::array<uint32_t, 3>& corners) const {
    return glm::cross(at(corners[1]) - at(corners[0]), at(corners[2]) - at(corners[0]));
  }
  BoxTree tree_of_held() const {
    std::vector<Box> boxes;
    for (const uint32_t point : held_) boxes.push_back({at(point), at(point)});
    return BoxTree(std::move(boxes));
  }
  void moved(double squared) { squared_moved_ = std::max(squared_moved_, squared); }

  /// Points go to the first held point that is near, one by one, so that none moves further than the
  /// tolerance.
  void join_points() {
    std::vector<std::vector<uint32_t>> triangles_at(surface_.points.size());
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      for (const uint32_t corner : surface_.triangles[i].vertices) {
        if (is_held(corner)) triangles_at[corner].push_back(i);
      }
    }
    const NearPoints near(surface_.points, held_);
    std::vector<uint8_t> gone(surface_.points.size(), 0);
    for (const uint32_t point : held_) {
      uint32_t target = point;
      near.visit(surface_.points[point], [&](uint32_t other) {
        if (other >= target || gone[other] || glm::distance(at(other), at(point)) > contact_steps) return;
        if (can_join(point, other, triangles_at[point])) target = other;
      });
      if (target == point) continue;
      joined_any_ = true;
      const glm::dvec3 way = at(target) - at(point);
      moved(glm::dot(way, way));
      for (const uint32_t index : triangles_at[point]) {
        std::array<uint32_t, 3>& corners = surface_.triangles[index].vertices;
        std::replace(corners.begin(), corners.end(), point, target);
        triangles_at[target].push_back(index);
      }
      triangles_at[point].clear();
      baked_.spans[target].extend(baked_.spans[point]);
      baked_.spans[point] = {};
      gone[point] = 1;
    }
    held_.erase(std::remove_if(held_.begin(), held_.end(), [&](uint32_t point) { return gone[point] != 0; }),
                held_.end());
  }

  bool can_join(uint32_t point, uint32_t target, const std::vector<uint32_t>& triangles) const {
    for (const uint32_t index : triangles) {
      std::array<uint32_t, 3> corners = surface_.triangles[index].vertices;
      const glm::dvec3 before = normal(corners);
      if (std::find(corners.begin(), corners.end(), target) != corners.end()) return false;
      std::replace(corners.begin(), corners.end(), point, target);
      if (!(glm::dot(before, normal(corners)) > 0)) return false;
    }
    return true;
  }

  /// For each edge between held points those that lie on it; false if there are none.
  bool find_dividers() {
    const BoxTree tree = tree_of_held();
    tsl::robin_set<Ends, KeyHash, KeyEqual> seen;
    for (const Triangle& triangle : surface_.triangles) {
      for (size_t k = 0; k < 3; ++k) {
        const Ends ends = ascending({triangle.vertices[k], triangle.vertices[(k + 1) % 3]});
        if (!is_held(ends[0]) || !is_held(ends[1]) || !seen.insert(ends).second) continue;
        std::vector<Divider> found = dividers_of(ends, tree);
        if (!found.empty()) dividers_[ends] = std::move(found);
      }
    }
    return !dividers_.empty();
  }

  static Ends ascending(const Ends& ends) { return ends[0] < ends[1] ? ends : Ends{ends[1], ends[0]}; }

  std::vector<Divider> dividers_of(const Ends& ends, const BoxTree& tree) const {
    std::vector<Divider> dividers;
    const glm::dvec3 from = at(ends[0]), along = at(ends[1]) - from;
    const double length = glm::length(along);
    if (!(length > 2 * contact_steps)) return dividers;
    tree.visit(RaySpan(from, along, 0, 1), contact_steps + 1, [&](uint32_t index) {
      const uint32_t point = held_[index];
      const double share = glm::dot(at(point) - from, along) / (length * length);
      const double margin = contact_steps / length;
      if (point == ends[0] || point == ends[1] || share < margin || share > 1 - margin) return;
      if (glm::distance(from + along * share, at(point)) <= contact_steps) dividers.push_back({share, point});
    });
    std::sort(dividers.begin(), dividers.end());
    return dividers;
  }

  void divide_edges() {
    std::vector<Triangle> triangles;
    std::vector<SurfaceCorners> colors;
    std::vector<CornerNormals> normals;
    std::vector<SourceObjectId> objects;
    for (size_t i = 0; i < surface_.triangles.size(); ++i) {
      Divided whole{
          surface_.triangles[i], of_triangle(surface_.colors, i), of_triangle(surface_.normals, i), {}};
      for (size_t k = 0; k < 3; ++k) {
        const Ends ends = {whole.triangle.vertices[k], whole.triangle.vertices[(k + 1) % 3]};
        const auto found = dividers_.find(ascending(ends));
        if (found == dividers_.end()) continue;
        whole.dividers[k] = found->second;
        if (ends[0] > ends[1]) {
          for (Divider& divider : whole.dividers[k]) divider.share = 1 - divider.share;
          std::reverse(whole.dividers[k].begin(), whole.dividers[k].end());
        }
      }
      divide(std::move(whole), [&](const Divided& piece) {
        triangles.push_back(piece.triangle);
        if (!surface_.colors.empty()) colors.push_back(piece.colors);
        if (!surface_.normals.empty()) normals.push_back(piece.normals);
        if (!baked_.objects.empty()) objects.push_back(baked_.objects[i]);
      });
    }
    surface_.triangles = std::move(triangles);
    surface_.colors = std::move(colors);
    surface_.normals = std::move(normals);
    baked_.objects = std::move(objects);
  }

  /// Cuts the triangle at one divider after the other.
  template <typename Take>
  void divide(Divided whole, const Take& take) {
    std::vector<Divided> waiting = {std::move(whole)};
    while (!waiting.empty()) {
      Divided triangle = std::move(waiting.back());
      waiting.pop_back();
      size_t edge = 0;
      while (edge < 3 && triangle.dividers[edge].empty()) ++edge;
      if (edge == 3) {
        take(triangle);
        continue;
      }
      cut(std::move(triangle), edge, waiting);
    }
  }

  void cut(Divided triangle, size_t edge, std::vector<Divided>& waiting) {
    const size_t next = (edge + 1) % 3, last = (edge + 2) % 3;
    std::vector<Divider>& dividers = triangle.dividers[edge];
    const size_t middle = dividers.size() / 2;
    const Divider divider = dividers[middle];
    Divided first = triangle, second = triangle;  // between the edge's first end, its second, and the divider
    first.triangle.vertices[next] = second.triangle.vertices[edge] = divider.point;
    const glm::dvec3 before = normal(triangle.triangle.vertices);
    const bool fits = glm::dot(before, normal(first.triangle.vertices)) > 0 &&
                      glm::dot(before, normal(second.triangle.vertices)) > 0;
    if (!fits) {
      dividers.erase(dividers.begin() + static_cast<std::ptrdiff_t>(middle));
      waiting.push_back(std::move(triangle));
      return;
    }
    const glm::dvec3 from = at(triangle.triangle.vertices[edge]);
    const glm::dvec3 along = at(triangle.triangle.vertices[next]) - from;
    const double share =
        std::clamp(glm::dot(at(divider.point) - from, along) / glm::dot(along, along), 0.0, 1.0);
    const glm::dvec3 off = from + along * share - at(divider.point);
    moved(glm::dot(off, off));
    first.colors[next] = second.colors[edge] = mixed(triangle.colors[edge], triangle.colors[next], share);
    first.normals[next] = second.normals[edge] = mixed(triangle.normals[edge], triangle.normals[next], share);
    const auto at_middle = static_cast<std::ptrdiff_t>(middle);
    first.dividers[edge].assign(dividers.begin(), dividers.begin() + at_middle);
    first.dividers[next].clear();
    second.dividers[edge].assign(dividers.begin() + at_middle + 1, dividers.end());
    second.dividers[last].clear();
    waiting.push_back(std::move(second));
    waiting.push_back(std::move(first));
  }

  void drop_lone_points() {
    Piece piece = without_lone_points(surface_);
    std::vector<LeafSpan> spans;
    for (const uint32_t source : piece.sources) spans.push_back(baked_.spans[source]);
    surface_ = std::move(piece.surface);
    baked_.spans = std::move(spans);
  }

  Baked& baked_;
  Surface& surface_;
  std::vector<uint32_t> held_;
  tsl::robin_map<Ends, std::vector<Divider>, KeyHash, KeyEqual> dividers_;
  bool joined_any_ = false;
  double squared_moved_ = 0;
};

}  // namespace

double stitch(Baked& baked) { return Stitcher(baked).run(); }

}  // namespace triptych
