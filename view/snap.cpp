#include "view/snap.hpp"

#include "base/hashing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

constexpr size_t most_facets = 20'000;
constexpr double least_turn = 0.02;  // the sine of a degree

/// Keys that lie close together come far apart: tables of unmixed ones grow without end.
struct Hash {
  template <typename Value, size_t count>
  size_t operator()(const std::array<Value, count>& key) const {
    return hash_values(std::span<const Value>(key));
  }
};

/// Numbers for places, the same for those within one cell.
class Welder {
 public:
  explicit Welder(double weld) : weld_(weld) {}
  uint32_t number(const glm::dvec3& point) {
    const std::array<double, 3> cell = {std::round(point.x / weld_) + 0.0, std::round(point.y / weld_) + 0.0,
                                        std::round(point.z / weld_) + 0.0};  // no −0
    const auto next = static_cast<uint32_t>(numbers_.size());
    return numbers_.try_emplace(cell, next).first->second;
  }

 private:
  double weld_;
  tsl::robin_map<std::array<double, 3>, uint32_t, Hash> numbers_;
};

struct Candidate {
  double distance;  ///< pixels from the cursor
  Snap snap;
};

/// The point of an edge that is seen nearest to the cursor; nullopt where all of it is before the near plane.
std::optional<Candidate> nearest_on(const FeatureEdge& edge, const NearCursor& near) {
  const PictureSpace& space = near.space();
  const double plane = space.view().camera.near;
  const glm::dvec3 a = space.from_eye(edge.from), b = space.from_eye(edge.to);
  double first = 0, last = 1;
  if (-a.z < plane && -b.z < plane) return std::nullopt;
  if (-a.z < plane) first = (-plane - a.z) / (b.z - a.z);
  if (-b.z < plane) last = (-plane - a.z) / (b.z - a.z);
  const glm::dvec3 from = a + first * (b - a), to = a + last * (b - a);
  const glm::dvec2 from_pixel = space.pixel(from), way = space.pixel(to) - from_pixel;
  const double square = glm::dot(way, way);
  const double seen =
      square > 0 ? std::clamp(glm::dot(near.cursor() - from_pixel, way) / square, 0.0, 1.0) : 0;
  // Halfway in the picture is not halfway in space.
  const double near_share = space.view().camera.orthographic() ? 1 : -from.z;
  const double far_share = space.view().camera.orthographic() ? 1 : -to.z;
  const double share = seen * near_share / ((1 - seen) * far_share + seen * near_share);
  Snap snap{SnapKind::edge,
            edge.from + (first + share * (last - first)) * (edge.to - edge.from),
            edge.from,
            edge.to,
            {},
            edge.drawable};
  return Candidate{glm::distance(near.cursor(), from_pixel + seen * way), snap};
}

/// Ends of edges, but for those in the middle of one straight line.
std::vector<Candidate> corners(const std::vector<FeatureEdge>& edges, const NearCursor& near, double weld) {
  struct Corner {
    glm::dvec3 point;
    DrawableId drawable;
    std::vector<glm::dvec3> ways;
  };
  std::vector<Corner> all;
  Welder welder(weld);
  for (const FeatureEdge& edge : edges) {
    for (const auto& [at, other] : {std::pair(edge.from, edge.to), std::pair(edge.to, edge.from)}) {
      const uint32_t number = welder.number(at);
      if (number == all.size()) all.push_back({at, edge.drawable, {}});
      all[number].ways.push_back(glm::normalize(other - at));
    }
  }
  std::vector<Candidate> found;
  for (const Corner& corner : all) {
    const auto& ways = corner.ways;
    const bool goes_on = ways.size() == 2 && glm::dot(ways[0], ways[1]) < 0 &&
                         glm::length(glm::cross(ways[0], ways[1])) < least_turn;
    const glm::dvec3 eye = near.space().from_eye(corner.point);
    if (goes_on || -eye.z < near.space().view().camera.near) continue;
    found.push_back({glm::distance(near.cursor(), near.space().pixel(eye)),
                     {SnapKind::vertex, corner.point, {}, {}, {}, corner.drawable}});
  }
  return found;
}

/// The nearest within reach that is seen.
std::optional<Snap> best(std::vector<Candidate> candidates, const NearCursor& near) {
  constexpr size_t most_tried = 24;
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.distance > snap_pixels; });
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (size_t i = 0; i < std::min(candidates.size(), most_tried); ++i) {
    if (near.sees(candidates[i].snap.point)) return candidates[i].snap;
  }
  return std::nullopt;
}

glm::dvec3 normal_of(const NearFacet& facet) {
  const auto& [a, b, c] = facet.corners;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double length = glm::length(normal);
  return length > 0 ? normal / length : glm::dvec3(0);
}

}  // namespace

std::vector<FeatureEdge> feature_edges(const std::vector<NearFacet>& facets, double weld, double turn) {
  Welder welder(weld);
  tsl::robin_map<std::array<uint32_t, 2>, size_t, Hash> known;
  std::vector<FeatureEdge> edges;
  for (const NearFacet& facet : facets) {
    const glm::dvec3 normal = normal_of(facet);
    if (normal == glm::dvec3(0)) continue;
    std::array<uint32_t, 3> numbers{};
    for (size_t k = 0; k < 3; ++k) numbers[k] = welder.number(facet.corners[k]);
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = numbers[k], b = numbers[(k + 1) % 3];
      if (a == b) continue;
      const std::array key = {std::min(a, b), std::max(a, b)};
      const auto [found, is_new] = known.try_emplace(key, edges.size());
      if (is_new) {
        edges.push_back({facet.corners[k], facet.corners[(k + 1) % 3], {normal, {}}, 1, facet.drawable});
        continue;
      }
      FeatureEdge& edge = edges[found->second];
      const double by = glm::length(glm::cross(edge.normals[0], normal));
      const bool second = edge.normals[1] == glm::dvec3(0);
      if (second || by > edge.turn) {
        edge.normals[1] = normal;
        edge.turn = by;
      }
    }
  }
  std::erase_if(edges, [&](const FeatureEdge& edge) { return edge.turn < turn; });
  return edges;
}

std::optional<Snap> snap(const NearCursor& near) {
  const std::vector<NearFacet> facets = near.facets(most_facets);
  const double weld = 0.5 * near.weld();
  const std::vector<FeatureEdge> edges = feature_edges(facets, weld, least_turn);
  if (const auto vertex = best(corners(edges, near, weld), near)) return vertex;
  std::vector<Candidate> on_edges;
  for (const FeatureEdge& edge : edges) {
    if (const auto candidate = nearest_on(edge, near)) on_edges.push_back(*candidate);
  }
  if (const auto edge = best(std::move(on_edges), near)) return edge;
  if (!near.hit()) return std::nullopt;
  Snap face{SnapKind::face, near.hit()->point, {}, {}, {}, near.hit()->drawable};
  face.normal = near.hit()->normal;
  return face;
}

}  // namespace triptych
