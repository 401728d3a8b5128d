#include "model/import/triangulate.hpp"

#include "model/import/import_limits.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <utility>

namespace triptych {

namespace {

/// Twice the signed area.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool holds(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& point) {
  return turn(a, b, point) >= 0 && turn(b, c, point) >= 0 && turn(c, a, point) >= 0;
}

/// The corners on the face's best plane, about its first corner, scaled to at most 1; counter-clockwise.
/// Empty where there is no such plane.
std::vector<glm::dvec2> on_best_plane(std::span<const glm::dvec3> corners) {
  double size = 0;
  for (const glm::dvec3& corner : corners) {
    if (!is_usable(corner)) return {};
    const glm::dvec3 from_first = glm::abs(corner - corners[0]);
    size = std::max({size, from_first.x, from_first.y, from_first.z});
  }
  if (!(size > 0)) return {};
  const auto scaled = [&](size_t i) { return (corners[i] - corners[0]) / size; };
  glm::dvec3 normal{0};  // Newell's normal: the sum over the fan
  for (size_t i = 2; i < corners.size(); ++i) normal += glm::cross(scaled(i - 1), scaled(i));
  const double length = glm::length(normal);
  if (!(length > 0)) return {};
  normal /= length;
  const glm::dvec3 sizes = glm::abs(normal);
  const glm::dvec3 other = sizes.x <= sizes.y && sizes.x <= sizes.z ? glm::dvec3(1, 0, 0)
                           : sizes.y <= sizes.z                     ? glm::dvec3(0, 1, 0)
                                                                    : glm::dvec3(0, 0, 1);
  const glm::dvec3 u = glm::normalize(glm::cross(other, normal)), v = glm::cross(normal, u);
  std::vector<glm::dvec2> points;
  points.reserve(corners.size());
  for (size_t i = 0; i < corners.size(); ++i)
    points.emplace_back(glm::dot(scaled(i), u), glm::dot(scaled(i), v));
  return points;
}

/// Corners by their place, so that those in a triangle are found without looking at all.
class CornerGrid {
 public:
  CornerGrid(const std::vector<glm::dvec2>& points, const std::vector<uint32_t>& corners) : points_(points) {
    for (const uint32_t corner : corners) {
      low_ = glm::min(low_, points[corner]);
      high_ = glm::max(high_, points[corner]);
    }
    side_ = static_cast<size_t>(std::sqrt(static_cast<double>(corners.size()))) + 1;
    cells_.resize(side_ * side_);
    for (const uint32_t corner : corners) {
      const auto [column, row] = cell_of(points[corner]);
      cells_[row * side_ + column].push_back(corner);
    }
  }

  void remove(uint32_t corner) {
    const auto [column, row] = cell_of(points_[corner]);
    std::erase(cells_[row * side_ + column], corner);
  }

  /// A corner within the box from low to high, or near it, for which `wanted` holds; nothing if there is
  /// none.
  template <typename Wanted>
  std::optional<uint32_t> find(const glm::dvec2& low, const glm::dvec2& high, const Wanted& wanted) const {
    const auto [first_column, first_row] = cell_of(low);
    const auto [last_column, last_row] = cell_of(high);
    for (size_t row = first_row; row <= last_row; ++row) {
      for (size_t column = first_column; column <= last_column; ++column) {
        const auto& cell = cells_[row * side_ + column];
        const auto found = std::find_if(cell.begin(), cell.end(), wanted);
        if (found != cell.end()) return *found;
      }
    }
    return std::nullopt;
  }

 private:
  /// Places beyond the grid belong to its outermost cells.
  std::pair<size_t, size_t> cell_of(const glm::dvec2& point) const {
    const auto along = [&](double value, double low, double high) {
      const double share = high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
      return std::min(static_cast<size_t>(share * static_cast<double>(side_)), side_ - 1);
    };
    return {along(point.x, low_.x, high_.x), along(point.y, low_.y, high_.y)};
  }

  const std::vector<glm::dvec2>& points_;
  glm::dvec2 low_{1e300}, high_{-1e300};
  size_t side_ = 1;
  std::vector<std::vector<uint32_t>> cells_;
};

class EarClipping {
 public:
  EarClipping(std::vector<glm::dvec2> points, std::vector<std::array<uint32_t, 3>>& triangles)
      : points_(std::move(points)), triangles_(triangles) {
    const auto count = static_cast<uint32_t>(points_.size());
    for (uint32_t i = 0; i < count; ++i) links_.push_back({(i + count - 1) % count, (i + 1) % count});
    for (uint32_t i = 0; i < count; ++i) {
      if (is_reflex(i)) reflex_.push_back(i);
    }
    is_listed_.resize(count, false);
    for (const uint32_t corner : reflex_) is_listed_[corner] = true;
  }

  /// Whether the fan of the first corner covers the face.
  bool is_convex() const {
    if (!reflex_.empty()) return false;
    // An outline that only turns left may still go around twice.
    for (size_t i = 2; i < points_.size(); ++i) {
      if (turn(points_[0], points_[i - 1], points_[i]) < 0) return false;
    }
    return true;
  }

  /// Each corner is tried once, and again only after what made it no ear has changed: one of its neighbours,
  /// or the corner that lay in it.
  void run() {
    grid_.emplace(points_, reflex_);
    const auto count = static_cast<uint32_t>(points_.size());
    blocked_.resize(count);
    std::deque<uint32_t> open;
    std::vector<bool> is_open(count, true), is_cut(count, false);
    const auto try_again = [&](uint32_t corner) {
      if (is_open[corner] || is_cut[corner]) return;
      is_open[corner] = true;
      open.push_back(corner);
    };
    // Skipping an ear's neighbour gives fewer slivers.
    for (uint32_t i = 0; i < count; i += 2) open.push_back((i + 1) % count);
    for (uint32_t i = 0; i < count; i += 2) open.push_back(i);
    size_t left = points_.size();
    while (left > 3 && !open.empty()) {
      const uint32_t at = open.front();
      open.pop_front();
      is_open[at] = false;
      if (is_cut[at] || !is_ear(at)) continue;
      const uint32_t before = links_[at].before, after = links_[at].next;
      triangles_.push_back({before, at, after});
      links_[before].next = after;
      links_[after].before = before;
      is_cut[at] = true;
      --left;
      for (const uint32_t corner : {before, after, at}) {
        // The neighbours of an ear can only become more convex.
        if (is_listed_[corner] && (corner == at || !is_reflex(corner))) {
          is_listed_[corner] = false;
          grid_->remove(corner);
          for (const uint32_t other : blocked_[corner]) try_again(other);
          blocked_[corner].clear();
        }
        try_again(corner);
      }
    }
    const auto uncut = static_cast<uint32_t>(std::find(is_cut.begin(), is_cut.end(), false) - is_cut.begin());
    const uint32_t first = links_[uncut].before;  // the rest is a triangle, or has no ear
    for (uint32_t corner = uncut; links_[corner].next != first; corner = links_[corner].next) {
      triangles_.push_back({first, corner, links_[corner].next});
    }
  }

 private:
  struct Link {
    uint32_t before, next;
  };
  bool is_reflex(uint32_t corner) const {
    return turn(points_[links_[corner].before], points_[corner], points_[links_[corner].next]) <= 0;
  }
  bool is_ear(uint32_t corner) {
    const uint32_t before = links_[corner].before, after = links_[corner].next;
    const glm::dvec2 &a = points_[before], &b = points_[corner], &c = points_[after];
    if (turn(a, b, c) <= 0) return false;
    const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const auto within = grid_->find(low, high, [&](uint32_t other) {
      // Corners that touch an end of the ear's base belong to a bridge between outline and hole.
      return other != before && other != after && points_[other] != a && points_[other] != c &&
             points_[other] != b && holds(a, b, c, points_[other]);
    });
    if (within) blocked_[*within].push_back(corner);
    return !within;
  }

  std::vector<glm::dvec2> points_;
  std::vector<std::array<uint32_t, 3>>& triangles_;
  std::vector<Link> links_;
  std::vector<uint32_t> reflex_;  ///< corners that are not convex at first; only they can lie in an ear
  std::vector<bool> is_listed_;   ///< whether a corner is in the grid: it is not convex
  std::optional<CornerGrid> grid_;
  std::vector<std::vector<uint32_t>>
      blocked_;  ///< for each corner those that are no ear since it lies in them
};

/// Cuts along the diagonal that leaves two triangles which face the same way; along the first corner's where
/// both do or neither.
std::array<std::array<uint32_t, 3>, 2> cut_quad(std::span<const glm::dvec3> corners) {
  const glm::dvec3 normal = glm::cross(corners[2] - corners[0], corners[3] - corners[1]);
  const auto faces_out = [&](size_t a, size_t b, size_t c) {
    return glm::dot(glm::cross(corners[b] - corners[a], corners[c] - corners[a]), normal) > 0;
  };
  const bool second = !(faces_out(0, 1, 2) && faces_out(0, 2, 3)) && faces_out(0, 1, 3) && faces_out(1, 2, 3);
  if (second) return {{{0, 1, 3}, {1, 2, 3}}};
  return {{{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<uint32_t, 3>>& triangles) {
  triangles.clear();
  if (corners.size() < 3) return;
  const auto count = static_cast<uint32_t>(corners.size());
  if (count == 4) {
    const auto halves = cut_quad(corners);
    triangles.assign(halves.begin(), halves.end());
    return;
  }
  if (count > 4 && count <= max_clipped_corners) {
    std::vector<glm::dvec2> points = on_best_plane(corners);
    if (!points.empty()) {
      EarClipping clipping(std::move(points), triangles);
      if (!clipping.is_convex()) return clipping.run();
    }
  }
  for (uint32_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
}

}  // namespace triptych
