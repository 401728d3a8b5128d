#include "preprocess/outward.hpp"

#include "preprocess/closed_groups.hpp"
#include "preprocess/triangle_contact.hpp"
#include "scene/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <tuple>

namespace triptych {

namespace {

/// So many pairs of triangles are looked at for each triangle of a surface, on average; of small ones more.
constexpr size_t max_pairs = 32, always_pairs = 4096;

using Corners = ClosedGroups::Corners;

/// For each point the lowest index of one at its place.
std::vector<uint32_t> first_at_place(std::span<const glm::ivec3> points) {
  const auto key = [&](uint32_t i) { return std::tuple(points[i].x, points[i].y, points[i].z, i); };
  std::vector<uint32_t> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return key(a) < key(b); });
  for (size_t i = 0; i < order.size(); ++i) {
    const bool again = i > 0 && points[order[i]] == points[order[i - 1]];
    first[order[i]] = again ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// Its share of the sphere around the origin, in steradians, for corners that go round clockwise as seen from
/// there (Van Oosterom and Strackee, The solid angle of a plane triangle, 1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  return 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
}

/// Whether every triangle shows its back to the middle of them all, and they go around that once: then a ray
/// from there meets the surface once, and it cannot meet itself.
bool is_star_shaped(std::span<const ExactTriangle> triangles) {
  glm::dvec3 sum(0);
  for (const ExactTriangle& triangle : triangles) {
    for (const glm::ivec3& corner : triangle.corners) sum += glm::dvec3(corner);
  }
  const glm::ivec3 middle(glm::round(sum / (3.0 * static_cast<double>(triangles.size()))));
  double angle = 0;
  for (const ExactTriangle& triangle : triangles) {
    if (!(triangle.volume_from(middle) > 0)) return false;
    const auto from_middle = [&](size_t k) { return glm::dvec3(triangle.corners[k]) - glm::dvec3(middle); };
    angle += solid_angle(from_middle(0), from_middle(1), from_middle(2));
  }
  return std::abs(angle - 4 * std::numbers::pi) < 1;
}

/// Whether no two triangles meet but where they share corners. Gives up, and says no, where boxes of too many
/// overlap (sweep along the longest axis).
bool meets_itself_nowhere(std::span<const ExactTriangle> triangles) {
  LatticeBox whole;
  std::vector<LatticeBox> boxes(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    for (const glm::ivec3& corner : triangles[i].corners) boxes[i].extend(corner);
    whole.extend(boxes[i]);
  }
  const int axis = whole.longest_axis();
  std::vector<uint32_t> order(triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return boxes[a].lo[axis] < boxes[b].lo[axis]; });
  size_t pairs = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    const LatticeBox& box = boxes[order[i]];
    for (size_t k = i + 1; k < order.size() && boxes[order[k]].lo[axis] <= box.hi[axis]; ++k) {
      if (++pairs > always_pairs + max_pairs * triangles.size()) return false;
      const LatticeBox& other = boxes[order[k]];
      const bool apart =
          glm::any(glm::lessThan(box.hi, other.lo)) || glm::any(glm::lessThan(other.hi, box.lo));
      if (!apart && !meet_only_where_shared(triangles[order[i]], triangles[order[k]])) return false;
    }
  }
  return true;
}

bool is_outward(std::span<const ExactTriangle> triangles) {
  if (std::any_of(triangles.begin(), triangles.end(), [](const auto& t) { return t.is_degenerate(); }))
    return false;
  return enclosed_volume(triangles) > 0 && (is_star_shaped(triangles) || meets_itself_nowhere(triangles));
}

}  // namespace

std::vector<bool> outward_triangles(std::span<const glm::ivec3> points, std::span<const uint32_t> indices,
                                    const std::vector<bool>& seen_through) {
  const std::vector<uint32_t> places = first_at_place(points);
  std::vector<Corners> triangles;
  std::vector<uint32_t> numbers;  // of those that have three corners
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const Corners corners{places[indices[i]], places[indices[i + 1]], places[indices[i + 2]]};
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    triangles.push_back(corners);
    numbers.push_back(static_cast<uint32_t>(i / 3));
  }
  std::vector<bool> outward(indices.size() / 3);
  std::vector<ExactTriangle> group;
  const auto shows_inside = [&](uint32_t i) { return !seen_through.empty() && seen_through[numbers[i]]; };
  ClosedGroups(points, triangles).visit([&](std::span<const uint32_t> members) {
    if (std::ranges::any_of(members, shows_inside)) return;
    group.clear();
    for (const uint32_t i : members) {
      const Corners& corners = triangles[i];
      group.emplace_back(std::array{points[corners[0]], points[corners[1]], points[corners[2]]});
    }
    if (!is_outward(group)) return;
    for (const uint32_t i : members) outward[numbers[i]] = true;
  });
  return outward;
}

}  // namespace triptych
