#include "preprocess/triangle_contact.hpp"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>

namespace triptych {

namespace {

/// Holds 3 · 2⁶¹ · 2³⁰, the largest of the sums below.
__extension__ using Wide = __int128;
using Corners = std::array<glm::ivec3, 3>;
using Vector = glm::i64vec3;

Vector between(const glm::ivec3& from, const glm::ivec3& to) { return Vector(to) - Vector(from); }

Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Wide dot(const Vector& a, const Vector& b) { return Wide{a.x} * b.x + Wide{a.y} * b.y + Wide{a.z} * b.z; }

/// Two triangles; corners that both have come first, in the same order.
struct Pair {
  Corners a, b;
  size_t shared = 0;

  Pair(const Corners& of_a, const Corners& of_b) : a(of_a), b(of_b) {
    for (size_t i = 0; i < 3; ++i) {
      const auto same = std::find(b.begin() + static_cast<std::ptrdiff_t>(shared), b.end(), a[i]);
      if (same == b.end()) continue;
      std::swap(*same, b[shared]);
      std::swap(a[i], a[shared]);
      ++shared;
    }
  }
};

/// How far the second and third corners are along an axis, from the first of `a`.
struct Reach {
  Wide second, third;
  Wide least() const { return std::min({second, third}); }
  Wide most() const { return std::max({second, third}); }
};

/// Strictly, no corner being shared.
bool separates(const Vector& axis, const Pair& pair) {
  const auto at = [&](const glm::ivec3& corner) { return dot(axis, between(pair.a[0], corner)); };
  const std::array<Wide, 3> a{0, at(pair.a[1]), at(pair.a[2])},
      b{at(pair.b[0]), at(pair.b[1]), at(pair.b[2])};
  const auto [least_a, most_a] = std::minmax_element(a.begin(), a.end());
  const auto [least_b, most_b] = std::minmax_element(b.begin(), b.end());
  return *most_a < *least_b || *most_b < *least_a;
}

/// Whether they go the same way, at an angle of zero.
bool same_direction(const Vector& a, const Vector& b) { return cross(a, b) == Vector(0) && dot(a, b) > 0; }

/// By the plane through the corner that they share: what lies in it are at most an edge of each, in different
/// directions.
bool separates_at_corner(const Vector& axis, const Pair& pair) {
  const Vector a1 = between(pair.a[0], pair.a[1]), a2 = between(pair.a[0], pair.a[2]),
               b1 = between(pair.a[0], pair.b[1]), b2 = between(pair.a[0], pair.b[2]);
  const Reach a{dot(axis, a1), dot(axis, a2)}, b{dot(axis, b1), dot(axis, b2)};
  if (!(a.most() <= 0 && b.least() >= 0) && !(b.most() <= 0 && a.least() >= 0)) return false;
  const auto in_plane = [](const Reach& reach) { return (reach.second == 0) + (reach.third == 0); };
  if (in_plane(a) == 0 || in_plane(b) == 0) return true;
  if (in_plane(a) == 2 || in_plane(b) == 2) return false;
  return !same_direction(a.second == 0 ? a1 : a2, b.second == 0 ? b1 : b2);
}

/// The axis in the plane of both triangles, at right angles to an edge: without the coordinate along which
/// the normal is longest, all keep their order.
Vector across(const Vector& edge, const Vector& normal) {
  const Vector size = glm::abs(normal);
  if (size.x >= size.y && size.x >= size.z) return {0, -edge.z, edge.y};
  if (size.y >= size.z) return {-edge.z, 0, edge.x};
  return {-edge.y, edge.x, 0};
}

/// Edges from the first corner, then the one between the others.
Vector edge_of(const Corners& corners, size_t i) {
  return i < 2 ? between(corners[0], corners[i + 1]) : between(corners[1], corners[2]);
}

/// Whether one of the axes that matter does: the normals, and what is at right angles to an edge of each; in
/// one plane, what is at right angles to an edge there.
template <typename Separates>
bool any_axis(const ExactTriangle& a, const ExactTriangle& b, const Pair& pair, bool in_one_plane,
              const Separates& separated) {
  const size_t edges = pair.shared == 0 ? 3 : 2;
  if (in_one_plane) {
    for (size_t i = 0; i < edges; ++i) {
      for (const Corners* corners : {&pair.a, &pair.b}) {
        if (separated(across(edge_of(*corners, i), a.normal), pair)) return true;
      }
    }
    return false;
  }
  if (separated(a.normal, pair) || separated(b.normal, pair)) return true;
  for (size_t i = 0; i < edges; ++i) {
    for (size_t k = 0; k < edges; ++k) {
      const Vector axis = cross(edge_of(pair.a, i), edge_of(pair.b, k));
      if (axis != Vector(0) && separated(axis, pair)) return true;
    }
  }
  return false;
}

}  // namespace

ExactTriangle::ExactTriangle(const std::array<glm::ivec3, 3>& of_corners)
    : corners(of_corners), normal(cross(between(corners[0], corners[1]), between(corners[0], corners[2]))) {}

double ExactTriangle::volume_from(const glm::ivec3& apex) const {
  return static_cast<double>(dot(normal, between(apex, corners[0])));
}

double enclosed_volume(std::span<const ExactTriangle> triangles) {
  Wide volume = 0;
  for (const ExactTriangle& triangle : triangles)
    volume += dot(triangle.normal, between(triangles[0].corners[0], triangle.corners[0]));
  return static_cast<double>(volume);
}

bool meet_only_where_shared(const ExactTriangle& a, const ExactTriangle& b) {
  const Pair pair(a.corners, b.corners);
  const bool in_one_plane = std::all_of(b.corners.begin(), b.corners.end(), [&](const glm::ivec3& corner) {
    return dot(a.normal, between(a.corners[0], corner)) == 0;
  });
  switch (pair.shared) {
    case 0:
      return any_axis(a, b, pair, in_one_plane, separates);
    case 1:
      return any_axis(a, b, pair, in_one_plane, separates_at_corner);
    case 2: {
      if (!in_one_plane) return true;
      const Vector axis = across(edge_of(pair.a, 0), a.normal);
      const auto side = [&](const glm::ivec3& corner) { return dot(axis, between(pair.a[0], corner)) > 0; };
      return side(pair.a[2]) != side(pair.b[2]);
    }
    default:
      return false;
  }
}

}  // namespace triptych
