#include "preprocess/contacts/inner_faces.hpp"

#include "preprocess/covered/error_gaps.hpp"
#include "simplify/component_covers.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

using Corners = std::array<uint32_t, 3>;
constexpr uint32_t none = 0xffffffffu;
/// Lattice steps. What goes on backwards lies lower than this behind a face; what is flat is not higher.
constexpr double clearly_behind = 1, flat = 0.01;

/// Turned so that the least comes first.
Corners turned(Corners corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

uint64_t edge_key(uint32_t from, uint32_t to) {
  return uint64_t{std::min(from, to)} << 32 | std::max(from, to);
}

/// A triangle at an edge, and its corner that is not on it.
struct Side {
  uint32_t triangle, opposite;
  bool forward;  ///< passes the edge from its lower point to its higher one
};

class InnerFaces {
 public:
  explicit InnerFaces(const Surface& surface)
      : surface_(surface), sets_(surface.triangles.size()), inner_(surface.triangles.size(), 0) {}

  std::vector<double> find() {
    find_twins();
    if (twins_ == 0) return std::vector<double>(inner_.size(), -1);
    find_sides();
    refuse_open_bodies();
    while (refuse_patches()) {
    }
    return reaches();
  }

 private:
  /// Marks triangles that lie on others which are turned the other way.
  void find_twins() {
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i)
      places_.insert({turned(surface_.triangles[i].vertices), i});
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const auto& [a, b, c] = surface_.triangles[i].vertices;
      if (at({a, c, b}) != none) mark(i);
    }
    find_crossed_twins();
  }

  /// Two triangles of a flat quadrangle that lie on two others, which divide it the other way.
  void find_crossed_twins() {
    tsl::robin_map<uint64_t, Side, KeyHash> first;
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      for (size_t k = 0; k < 3; ++k) {
        const Side own = side_of(i, k);
        const uint64_t key =
            edge_key(surface_.triangles[i].vertices[k], surface_.triangles[i].vertices[(k + 1) % 3]);
        const auto [found, inserted] = first.try_emplace(key, own);
        if (inserted || found->second.forward == own.forward) continue;
        mark_crossed(found->second, own, static_cast<uint32_t>(key >> 32), static_cast<uint32_t>(key));
      }
    }
  }

  /// one, other: on both sides of the edge from `low` to `high`.
  void mark_crossed(const Side& one, const Side& other, uint32_t low, uint32_t high) {
    if (inner_[one.triangle] || inner_[other.triangle]) return;
    const uint32_t left = one.forward ? one.opposite : other.opposite,
                   right = one.forward ? other.opposite : one.opposite;
    // From the front the quadrangle goes round by low, right, high, left.
    const uint32_t a = at({left, right, low}), b = at({right, left, high});
    if (a == none || b == none || inner_[a] || inner_[b]) return;
    if (std::abs(height(other.opposite, one.triangle)) > flat) return;
    for (const uint32_t triangle : {one.triangle, other.triangle, a, b}) mark(triangle);
  }

  void mark(uint32_t triangle) {
    twins_ += !inner_[triangle];
    inner_[triangle] = 1;
  }

  uint32_t at(const Corners& corners) const {
    const auto found = places_.find(turned(corners));
    return found == places_.end() ? none : found->second;
  }

  Side side_of(uint32_t triangle, size_t k) const {
    const auto& vertices = surface_.triangles[triangle].vertices;
    return {triangle, vertices[(k + 2) % 3], vertices[k] < vertices[(k + 1) % 3]};
  }

  void find_sides() {
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const auto& vertices = surface_.triangles[i].vertices;
      for (size_t k = 0; k < 3; ++k) {
        std::vector<Side>& sides = sides_[edge_key(vertices[k], vertices[(k + 1) % 3])];
        if (!sides.empty()) sets_.join(sides.front().triangle, i);
        sides.push_back(side_of(i, k));
      }
    }
  }

  /// Of what hangs together by edges, one of which is passed more often one way.
  void refuse_open_bodies() {
    std::vector<uint8_t> open(inner_.size(), 0);
    for (const auto& [key, sides] : sides_) {
      const auto forward = std::ranges::count_if(sides, &Side::forward);
      if (2 * static_cast<size_t>(forward) != sides.size()) open[sets_.root(sides.front().triangle)] = 1;
    }
    for (uint32_t i = 0; i < inner_.size(); ++i) inner_[i] = inner_[i] && !open[sets_.root(i)];
  }

  /// Joins the inner triangles at an edge, and returns the first; none if there are none.
  uint32_t join_inner(const std::vector<Side>& sides, DisjointSets& patches) const {
    uint32_t first = none;
    for (const Side& side : sides) {
      if (!inner_[side.triangle]) continue;
      if (first == none) first = side.triangle;
      patches.join(first, side.triangle);
    }
    return first;
  }

  /// Refuses patches at whose edges something is not as it must be; whether there were any.
  bool refuse_patches() {
    DisjointSets patches(inner_.size());
    std::vector<uint8_t> refused(inner_.size(), 0);
    for (const auto& [key, sides] : sides_) {
      const uint32_t first = join_inner(sides, patches);
      if (first != none && !is_sound(sides)) refused[first] = 1;
    }
    std::vector<uint8_t> of_patch(inner_.size(), 0);
    for (uint32_t i = 0; i < inner_.size(); ++i) of_patch[patches.root(i)] |= refused[i];
    bool any = false;
    for (uint32_t i = 0; i < inner_.size(); ++i) {
      if (!inner_[i] || !of_patch[patches.root(i)]) continue;
      inner_[i] = 0;
      any = true;
    }
    return any;
  }

  /// Whether the edge lies within a patch, or at its rim, where both bodies go on backwards.
  bool is_sound(const std::vector<Side>& sides) const {
    std::vector<Side> inner, others;
    for (const Side& side : sides) (inner_[side.triangle] ? inner : others).push_back(side);
    if (others.empty()) {
      // A single sheet with two sides ends where its last two triangles have the same third corner.
      return inner.size() == 4 || (inner.size() == 2 && inner[0].opposite != inner[1].opposite);
    }
    if (inner.size() != 2 || others.size() != 2) return false;
    if (inner[0].forward == inner[1].forward || others[0].forward == others[1].forward) return false;
    for (const Side& face : inner) {
      const Side& next = others[0].forward == face.forward ? others[1] : others[0];
      if (height(next.opposite, face.triangle) > -clearly_behind) return false;
    }
    return true;
  }

  /// Of a point above the plane of a triangle, lattice steps.
  double height(uint32_t point, uint32_t triangle) const {
    const auto& [a, b, c] = surface_.triangles[triangle].vertices;
    const glm::dvec3 origin(surface_.points[a]);
    const glm::dvec3 normal =
        glm::cross(glm::dvec3(surface_.points[b]) - origin, glm::dvec3(surface_.points[c]) - origin);
    return glm::dot(glm::dvec3(surface_.points[point]) - origin, glm::normalize(normal));
  }

  /// For each inner triangle how far any of its patch is from what stays.
  /// The distance to an edge is convex, so it is largest at the corner that is not on it; that to a point, at
  /// a corner, too.
  std::vector<double> reaches() {
    std::vector<uint8_t> stays(surface_.points.size(), 0);
    for (uint32_t i = 0; i < inner_.size(); ++i) {
      if (inner_[i]) continue;
      for (const uint32_t vertex : surface_.triangles[i].vertices) stays[vertex] = 1;
    }
    DisjointSets patches(inner_.size());
    for (const auto& [key, sides] : sides_) join_inner(sides, patches);
    std::vector<double> of_patch(inner_.size(), 0), found(inner_.size(), -1);
    for (uint32_t i = 0; i < inner_.size(); ++i) {
      double& furthest = of_patch[patches.root(i)];
      if (inner_[i]) furthest = std::max(furthest, reach_of(surface_.triangles[i].vertices, stays));
    }
    for (uint32_t i = 0; i < inner_.size(); ++i) {
      if (inner_[i]) found[i] = of_patch[patches.root(i)];
    }
    return found;
  }

  double reach_of(const Corners& corners, const std::vector<uint8_t>& stays) const {
    double least = 1e300;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t from = corners[k], to = corners[(k + 1) % 3];
      const glm::dvec3 a(surface_.points[from]), b(surface_.points[to]),
          c(surface_.points[corners[(k + 2) % 3]]);
      if (stays[from]) least = std::min(least, std::max(glm::distance(a, b), glm::distance(a, c)));
      const std::vector<Side>& sides = sides_.at(edge_key(from, to));
      if (std::ranges::all_of(sides, [&](const Side& side) { return inner_[side.triangle] != 0; })) continue;
      const double along = std::clamp(glm::dot(c - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
      least = std::min(least, glm::distance(c, a + (b - a) * along));
    }
    return least;
  }

  const Surface& surface_;
  DisjointSets sets_;           ///< triangles that hang together by edges
  std::vector<uint8_t> inner_;  ///< for each triangle, as far as is known
  size_t twins_ = 0;
  tsl::robin_map<Corners, uint32_t, KeyHash, KeyEqual> places_;  ///< triangles by their turned corners
  tsl::robin_map<uint64_t, std::vector<Side>, KeyHash> sides_;   ///< by edge
};

}  // namespace

std::vector<double> find_inner_faces(const Surface& surface) { return InnerFaces(surface).find(); }

void mark_inner_faces(Surface& surface, double most, double moved) {
  const std::vector<double> reaches = find_inner_faces(surface);
  for (size_t i = 0; i < reaches.size(); ++i) {
    const uint32_t of_class = class_of_distance(reaches[i] + moved);
    if (reaches[i] < 0 || distance_of_class(of_class) > most) continue;
    uint32_t& material = surface.triangles[i].material;
    material = material_covered(material_seen(material), of_class);
  }
}

}  // namespace triptych
