#include "preprocess/contacts/grow_joints.hpp"

#include "preprocess/covered/error_gaps.hpp"
#include "scene/ray.hpp"
#include "simplify/box_tree.hpp"
#include "simplify/component_covers.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace triptych {

namespace {

/// Lattice steps. What lies against each other is no further apart, and flat faces no less flat, than
/// rounding to the lattice may leave.
constexpr double near = 1.75;
/// Sines of angles between what counts as parallel.
constexpr double parallel = 1e-3;
/// Rays start so far from the rim of a face, as a share of the way to its middle.
constexpr double inset = 1.0 / 64;

class Joints {
 public:
  Joints(const Baked& baked, std::span<const uint8_t> fixed, double most)
      : surface_(baked.surface), fixed_(fixed), most_(most), covers_(baked.surface) {
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      normals_.push_back(normal_of(i));
      const Cover& cover = covers_.covers[component_of(i)];
      if (cover.is_rod() && cover.across() <= most) of_rods_.push_back(i);
    }
  }

  /// What each point moves by; empty if none does.
  std::vector<glm::ivec3> find() {
    if (of_rods_.empty()) return {};
    find_neighbours();
    std::vector<Box> boxes;
    for (const uint32_t triangle : of_rods_) boxes.push_back(box_of(triangle));
    tree_.emplace(std::move(boxes));
    std::vector<uint8_t> seen(surface_.triangles.size(), 0);
    std::vector<glm::dvec3> moves;
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      if (seen[i] || !lies_against_rod(i)) continue;
      const std::vector<uint32_t> face = face_of(i, seen);
      const double depth = depth_behind(face) / 2;
      if (depth < 1 || depth > most_) continue;
      if (moves.empty()) moves.resize(surface_.points.size(), glm::dvec3(0));
      for (const uint32_t point : points_of(face)) moves[point] += normals_[i] * depth;
    }
    std::vector<glm::ivec3> rounded;
    for (const glm::dvec3& move : moves) rounded.emplace_back(glm::round(move));
    return rounded;
  }

 private:
  glm::dvec3 point(uint32_t index) const { return glm::dvec3(surface_.points[index]); }
  uint32_t component_of(uint32_t triangle) const {
    return covers_.component_of[surface_.triangles[triangle].vertices[0]];
  }
  glm::dvec3 normal_of(uint32_t triangle) const {
    const auto& [a, b, c] = surface_.triangles[triangle].vertices;
    return glm::normalize(area_normal(point(a), point(b), point(c)));
  }
  Box box_of(uint32_t triangle) const {
    Box box;
    for (const uint32_t vertex : surface_.triangles[triangle].vertices) box.extend(point(vertex));
    return box;
  }
  /// Of a point above the plane of a triangle.
  double height(uint32_t of_point, uint32_t triangle) const {
    return glm::dot(point(of_point) - point(surface_.triangles[triangle].vertices[0]), normals_[triangle]);
  }

  void find_neighbours() {
    at_point_.resize(surface_.points.size());
    for (uint32_t i = 0; i < surface_.triangles.size(); ++i) {
      for (const uint32_t vertex : surface_.triangles[i].vertices) at_point_[vertex].push_back(i);
    }
  }

  /// Whether it lies on a triangle of a rod that is turned the other way.
  bool lies_against_rod(uint32_t triangle) const {
    bool found = false;
    tree_->visit_while(grown(box_of(triangle), near), [&](uint32_t index) {
      const uint32_t other = of_rods_[index];
      found = component_of(other) != component_of(triangle) &&
              glm::dot(normals_[triangle], normals_[other]) < -1 + parallel * parallel &&
              std::ranges::all_of(surface_.triangles[triangle].vertices,
                                  [&](uint32_t vertex) { return std::abs(height(vertex, other)) <= near; });
      return !found;
    });
    return found;
  }

  /// The triangles that go on from this one in its plane.
  std::vector<uint32_t> face_of(uint32_t first, std::vector<uint8_t>& seen) const {
    std::vector<uint32_t> face{first};
    seen[first] = 1;
    for (size_t next = 0; next < face.size(); ++next) {
      for (const uint32_t vertex : surface_.triangles[face[next]].vertices) {
        for (const uint32_t other : at_point_[vertex]) {
          if (seen[other] || !is_in_plane(other, first)) continue;
          seen[other] = 1;
          face.push_back(other);
        }
      }
    }
    return face;
  }

  bool is_in_plane(uint32_t triangle, uint32_t of) const {
    return glm::dot(normals_[triangle], normals_[of]) > 1 - parallel * parallel &&
           std::ranges::all_of(surface_.triangles[triangle].vertices,
                               [&](uint32_t vertex) { return std::abs(height(vertex, of)) <= near; });
  }

  std::vector<uint32_t> points_of(const std::vector<uint32_t>& face) const {
    std::vector<uint32_t> points;
    for (const uint32_t triangle : face) {
      const auto& vertices = surface_.triangles[triangle].vertices;
      points.insert(points.end(), vertices.begin(), vertices.end());
    }
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
  }

  /// The least thickness of the rods that lie against the face, wherever it was looked at; 0 where there is
  /// none, or where the face cannot be moved.
  double depth_behind(const std::vector<uint32_t>& face) const {
    const glm::dvec3& normal = normals_[face.front()];
    const std::vector<uint32_t> points = points_of(face);
    glm::dvec3 middle(0);
    for (const uint32_t at : points) {
      if (fixed_[at] || !goes_on_backwards(at, face)) return 0;
      middle += point(at) / static_cast<double>(points.size());
    }
    double least = depth_at(middle, normal, face.front());
    for (const uint32_t at : points) {
      if (least < 2) return 0;
      least = std::min(least, depth_at(glm::mix(point(at), middle, inset), normal, face.front()));
    }
    return least;
  }

  /// Whether all other triangles at a point of the face are of its body, and at right angles to it, behind.
  bool goes_on_backwards(uint32_t at, const std::vector<uint32_t>& face) const {
    return std::ranges::all_of(at_point_[at], [&](uint32_t other) {
      if (is_in_plane(other, face.front())) return true;
      return std::abs(glm::dot(normals_[other], normals_[face.front()])) <= parallel &&
             std::ranges::all_of(surface_.triangles[other].vertices,
                                 [&](uint32_t vertex) { return height(vertex, face.front()) <= near; });
    });
  }

  /// How thick the rods that begin at a point are there, along a direction.
  double depth_at(const glm::dvec3& from, const glm::dvec3& direction, uint32_t triangle) const {
    const RaySpan ray(from, direction, -near, 2 * most_ + near);
    std::vector<uint32_t> entered;
    std::vector<std::pair<double, uint32_t>> left;
    tree_->visit(ray, near, [&](uint32_t index) {
      const uint32_t other = of_rods_[index], body = component_of(other);
      if (body == component_of(triangle)) return;
      const auto& [a, b, c] = surface_.triangles[other].vertices;
      const auto hit = meet_triangle(from, direction, point(a), point(b), point(c));
      if (!hit) return;
      if (!hit->leaves && std::abs(hit->along) <= near) entered.push_back(body);
      if (hit->leaves && hit->along > near) left.emplace_back(hit->along, body);
    });
    double deepest = 0;
    for (const uint32_t body : entered) {
      double end = 1e300;
      for (const auto& [along, other] : left)
        if (other == body) end = std::min(end, along);
      if (end < 1e300) deepest = std::max(deepest, end);
    }
    return deepest;
  }

  const Surface& surface_;
  std::span<const uint8_t> fixed_;
  double most_;
  ComponentCovers covers_;
  std::vector<glm::dvec3> normals_;              ///< of triangles
  std::vector<uint32_t> of_rods_;                ///< triangles
  std::optional<BoxTree> tree_;                  ///< of those
  std::vector<std::vector<uint32_t>> at_point_;  ///< triangles
};

/// Of a covered triangle, where it or what covers it may have moved so far.
uint32_t further_covered(uint32_t material, double moved) {
  const uint32_t of_class = covered_class(material);
  if (of_class == 0) return material;
  return material_covered(material_seen(material), class_of_distance(distance_of_class(of_class) + moved));
}

}  // namespace

double grow_joints(Baked& baked, std::span<const uint8_t> fixed, double most) {
  const std::vector<glm::ivec3> moves = Joints(baked, fixed, most).find();
  double furthest = 0;
  for (size_t i = 0; i < moves.size(); ++i) {
    baked.surface.points[i] += moves[i];
    furthest = std::max(furthest, glm::length(glm::dvec3(moves[i])));
  }
  if (furthest > 0) {
    for (Triangle& triangle : baked.surface.triangles)
      triangle.material = further_covered(triangle.material, furthest);
  }
  return furthest;
}

}  // namespace triptych
