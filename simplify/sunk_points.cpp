#include "simplify/sunk_points.hpp"

#include "simplify/box_tree.hpp"
#include "simplify/key_hash.hpp"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tsl/robin_set.h>

namespace triptych {

namespace {

double volume_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  return glm::dot(glm::cross(b - a, c - a), d - a);
}

class SunkPoints {
 public:
  explicit SunkPoints(const Surface& surface)
      : surface_(surface), sets_(connected_points(surface)), sunk_(surface.points.size(), 0) {
    for (uint32_t i = 0; i < surface.points.size(); ++i) component_.push_back(sets_.root(i));
  }

  std::vector<uint8_t> find() {
    const bool is_one =
        std::ranges::all_of(component_, [&](uint32_t root) { return root == component_.front(); });
    if (!is_one) find_bodies();  // otherwise there is nothing that could be sunk in another
    if (!bodies_.empty()) look_along_edges();
    for (const Triangle& triangle : surface_.triangles) {
      if (covered_class(triangle.material) == 0) continue;
      for (const uint32_t vertex : triangle.vertices) sunk_[vertex] = sunk;
    }
    for (uint8_t& point : sunk_) point = point == sunk;
    if (std::ranges::count(sunk_, 1) == 0) return {};
    return std::move(sunk_);
  }

 private:
  /// Bits of a point; one that is both is neither.
  static constexpr uint8_t sunk = 1, outside = 2;

  glm::dvec3 place(uint32_t point) const { return glm::dvec3(surface_.points[point]); }

  /// Triangles of components each of whose edges is passed both ways, once each, around a positive volume.
  void find_bodies() {
    std::vector<uint8_t> open(surface_.points.size(), 0);
    std::vector<double> volumes(surface_.points.size(), 0);
    tsl::robin_set<uint64_t, KeyHash> sides;
    const auto each_side = [&](const auto& take) {
      for (const Triangle& triangle : surface_.triangles) {
        for (size_t k = 0; k < 3; ++k) take(triangle.vertices[k], triangle.vertices[(k + 1) % 3]);
      }
    };
    each_side([&](uint32_t from, uint32_t to) {
      if (!sides.insert(uint64_t{from} << 32 | to).second) open[component_[from]] = 1;
    });
    each_side([&](uint32_t from, uint32_t to) {
      if (!sides.contains(uint64_t{to} << 32 | from)) open[component_[from]] = 1;
    });
    for (const Triangle& triangle : surface_.triangles) {
      const auto& [a, b, c] = triangle.vertices;
      const glm::dvec3 origin = place(component_[a]);
      volumes[component_[a]] += volume_of(origin, place(a), place(b), place(c));
    }
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      const uint32_t component = component_[surface_.triangles[i].vertices[0]];
      if (!open[component] && volumes[component] > 0) bodies_.push_back(i);
    }
  }

  void look_along_edges() {
    std::vector<Box> boxes;
    for (const uint32_t triangle : bodies_) {
      Box box;
      for (const uint32_t vertex : surface_.triangles[triangle].vertices) box.extend(place(vertex));
      boxes.push_back(box);
    }
    const BoxTree tree(std::move(boxes));
    tsl::robin_set<uint64_t, KeyHash> seen;
    const std::vector<uint8_t> meets = components_that_meet_bodies();
    for (const Triangle& triangle : surface_.triangles) {
      for (size_t k = 0; k < 3; ++k) {
        const uint32_t from = triangle.vertices[k], to = triangle.vertices[(k + 1) % 3];
        if (!meets[component_[from]]) continue;
        if (!seen.insert(uint64_t{std::min(from, to)} << 32 | std::max(from, to)).second) continue;
        Box box;
        box.extend(place(from));
        box.extend(place(to));
        tree.visit(box, [&](uint32_t index) { look_through(surface_.triangles[bodies_[index]], from, to); });
      }
    }
  }

  /// By root: those whose box overlaps that of a body that is another component.
  std::vector<uint8_t> components_that_meet_bodies() const {
    std::vector<Box> boxes(surface_.points.size()), of_bodies;
    for (uint32_t i = 0; i < surface_.points.size(); ++i) boxes[component_[i]].extend(place(i));
    std::vector<uint8_t> is_body(boxes.size(), 0), meets(boxes.size(), 0);
    for (const uint32_t triangle : bodies_) is_body[component_[surface_.triangles[triangle].vertices[0]]] = 1;
    std::vector<uint32_t> roots;
    for (uint32_t root = 0; root < boxes.size(); ++root) {
      if (!is_body[root]) continue;
      roots.push_back(root);
      of_bodies.push_back(boxes[root]);
    }
    const BoxTree tree(std::move(of_bodies));
    for (uint32_t root = 0; root < boxes.size(); ++root) {
      if (component_[root] == root)
        tree.visit(boxes[root], [&](uint32_t body) { meets[root] |= roots[body] != root; });
    }
    return meets;
  }

  /// Marks the ends of an edge that passes through a triangle of another component.
  void look_through(const Triangle& face, uint32_t from, uint32_t to) {
    const auto& [a, b, c] = face.vertices;
    if (component_[a] == component_[from]) return;
    const glm::dvec3 p = place(a), q = place(b), r = place(c), s = place(from), t = place(to);
    const double before = volume_of(p, q, r, s), behind = volume_of(p, q, r, t);
    if (!((before > 0 && behind < 0) || (before < 0 && behind > 0))) return;
    const double one = volume_of(s, t, p, q), two = volume_of(s, t, q, r), three = volume_of(s, t, r, p);
    if (!((one > 0 && two > 0 && three > 0) || (one < 0 && two < 0 && three < 0))) return;
    sunk_[before < 0 ? from : to] |= sunk;
    sunk_[before < 0 ? to : from] |= outside;
  }

  const Surface& surface_;
  DisjointSets sets_;
  std::vector<uint32_t> component_;  ///< of each point
  std::vector<uint32_t> bodies_;     ///< triangles
  std::vector<uint8_t> sunk_;
};

}  // namespace

std::vector<uint8_t> sunk_points(const Surface& surface) { return SunkPoints(surface).find(); }

}  // namespace triptych
