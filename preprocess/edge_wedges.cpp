#include "preprocess/edge_wedges.hpp"

#include <algorithm>
#include <glm/ext/vector_int3_sized.hpp>

namespace triptych {

namespace {

/// Differences have 31 bits; the largest sums below have 126.
__extension__ using Wide = __int128;
using Vector = glm::i64vec3;

Wide dot(const Vector& a, const Vector& b) { return Wide{a.x} * b.x + Wide{a.y} * b.y + Wide{a.z} * b.z; }

Wide determinant(const Vector& a, const Vector& b, const Vector& c) {
  return dot(a, {b.y * c.z - b.z * c.y, b.z * c.x - b.x * c.z, b.x * c.y - b.y * c.x});
}

/// Directions around an edge, counted from one of them, counter-clockwise about low to high.
class Turn {
 public:
  Turn(const Vector& edge, const Vector& from) : edge_(edge), from_(from) {}

  bool before(const Vector& a, const Vector& b) const {
    const int of_a = half(a), of_b = half(b);
    return of_a != of_b ? of_a < of_b : determinant(edge_, a, b) > 0;
  }

 private:
  /// 0: the first direction; 1: up to the opposite one; 2: that; 3: beyond it.
  int half(const Vector& direction) const {
    const Wide side = determinant(edge_, from_, direction);
    if (side != 0) return side > 0 ? 1 : 3;
    const Wide along = dot(from_, direction) * dot(edge_, edge_) - dot(from_, edge_) * dot(direction, edge_);
    return along > 0 ? 0 : 2;
  }

  Vector edge_, from_;
};

}  // namespace

std::vector<std::pair<uint32_t, uint32_t>> wedges_at(const glm::ivec3& low, const glm::ivec3& high,
                                                     std::span<EdgeTriangle> triangles) {
  const auto from_low = [&](const glm::ivec3& point) { return Vector(point) - Vector(low); };
  const Turn turn(from_low(high), from_low(triangles.front().apex));
  // What is solid lies behind a triangle: clockwise of one that goes forward, counter-clockwise of the
  // others.
  std::sort(triangles.begin(), triangles.end(), [&](const EdgeTriangle& a, const EdgeTriangle& b) {
    const Vector of_a = from_low(a.apex), of_b = from_low(b.apex);
    if (turn.before(of_a, of_b)) return true;
    if (turn.before(of_b, of_a)) return false;
    return a.forward && !b.forward;
  });
  // Where two lie upon each other and look the same way, neither is told from the other.
  const auto doubled = [&](const EdgeTriangle& a, const EdgeTriangle& b) {
    const Vector of_a = from_low(a.apex), of_b = from_low(b.apex);
    return &a != &b && a.forward == b.forward && !turn.before(of_a, of_b) && !turn.before(of_b, of_a);
  };
  const size_t count = triangles.size();
  std::vector<std::pair<uint32_t, uint32_t>> wedges;
  for (size_t i = 0; i < count; ++i) {
    const EdgeTriangle &one = triangles[i], &next = triangles[(i + 1) % count];
    if (one.forward || !next.forward) continue;
    if (doubled(triangles[(i + count - 1) % count], one) || doubled(next, triangles[(i + 2) % count]))
      continue;
    wedges.emplace_back(one.number, next.number);
  }
  return wedges;
}

}  // namespace triptych
