#include "simplify/fan.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace triptych {

namespace {

/// Relative to the size of the terms; a hundred times the rounding error of so few steps.
constexpr double rounding = 1e-13;

template <typename Point>
double cross(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

bool ProjectedStar::project(std::span<const glm::dvec3> corners, bool closed, const glm::dvec3& direction) {
  size_ = corners.size();
  closed_ = closed;
  const double length = glm::length(direction);
  if (!(length > 0)) return false;
  const glm::dvec3 up = direction / length;
  // Any axes perpendicular to it (Duff et al., Building an orthonormal basis, revisited, 2017).
  const double sign = std::copysign(1.0, up.z), a = -1 / (sign + up.z), b = up.x * up.y * a;
  const glm::dvec3 right{1 + sign * up.x * up.x * a, sign * b, -sign * up.x};
  const glm::dvec3 forward{b, sign + up.y * up.y * a, -up.y};
  corners_.resize(2 * size_);
  reach_ = 0;
  for (size_t i = 0; i < size_; ++i) {
    const glm::dvec3& c = corners[i];
    corners_[i] = {glm::dot(c, right), glm::dot(c, forward), glm::dot(c, up), glm::length(c)};
    corners_[i + size_] = corners_[i];
    reach_ = std::max(reach_, corners_[i].length);
  }
  int turns = 0;
  for (size_t i = 0; i < (closed ? size_ : size_ - 1); ++i) {
    const Corner &from = corners_[i], &to = corners_[i + 1], &first = corners_[0];
    if (!(cross(from, to) > rounding * reach_ * (from.length + to.length))) return false;
    turns += from.y < 0 && to.y >= 0;
    // Half a turn in all: only the last corner may lie on or beyond the line through the first.
    if (!closed && i > 0 && !(cross(first, from) > rounding * reach_ * (first.length + from.length)))
      return false;
  }
  return !closed || turns == 1;
}

bool ProjectedStar::fan_errors(size_t apex, std::span<const double> star_errors,
                               std::span<double> fan_errors) {
  const size_t triangles = closed_ ? size_ : size_ - 1;
  const bool mirror = !closed_ && apex > 0;
  const auto place = [&](size_t i) {
    const size_t turned = mirror ? size_ - 2 - i : i + apex;
    return closed_ && turned >= size_ ? turned - size_ : turned;
  };
  errors_.resize(triangles);
  for (size_t i = 0; i < triangles; ++i) errors_[i] = star_errors[place(i)];
  const Corner* first = corners_.data() + apex;
  if (mirror) {
    mirrored_.resize(size_);
    for (size_t i = 0; i < size_; ++i) {
      mirrored_[i] = corners_[size_ - 1 - i];
      mirrored_[i].x = -mirrored_[i].x;
    }
    first = mirrored_.data();
  }
  if (!errors_from_first(first)) return false;
  for (size_t i = 1; i + 1 < size_; ++i) fan_errors[place(i)] = errors_[i];
  return true;
}

bool ProjectedStar::errors_from_first(const Corner* corners) {
  const Corner& apex = corners[0];
  // The height between the lines, or the plane and the point, that four points span.
  const auto gap = [&](const Corner& b, const Corner& c, double doubled_area) {
    const double volume = apex.x * (b.y * c.height - b.height * c.y) +
                          apex.y * (b.height * c.x - b.x * c.height) + apex.height * (b.x * c.y - b.y * c.x);
    return (std::abs(volume) + rounding * apex.length * b.length * c.length) / doubled_area;
  };
  gaps_.assign(size_, 0);  // on the diagonals, (apex, j)
  over_triangles_.resize(size_);
  carried_.resize(size_);
  size_t over = closed_ ? 0 : size_ - 2;  // the triangle of the fan that the point lies over
  for (size_t j = 1; j + 1 < size_; ++j) {
    const Corner &a = corners[j], &b = corners[j + 1];
    const double ax = a.x - apex.x, ay = a.y - apex.y, bx = b.x - apex.x, by = b.y - apex.y;
    const double doubled_area = ax * by - ay * bx;
    if (!(doubled_area > rounding * reach_ * (apex.length + a.length + b.length))) return false;
    over_triangles_[j] = 0;
    if (over == 0 && cross(apex, b) <= 0) {
      over = j;
      over_triangles_[j] = gap(a, b, doubled_area);
    }
    if (j == 1) continue;
    // The diagonal divides the polygon; the spokes to corners on the other side of it from the point cross
    // it.
    const bool point_is_left = !closed_ || cross(apex, a) > 0;
    const size_t first = point_is_left ? 1 : j + 1, end = point_is_left ? j : size_;
    for (size_t i = first; i < end; ++i) {
      const Corner& spoke = corners[i];
      const double area = std::abs(spoke.x * ay - spoke.y * ax);
      const double least = rounding * spoke.length * (apex.length + a.length);
      if (!(area > least)) return false;
      gaps_[j] = std::max(gaps_[j], gap(spoke, a, area - 0.01 * least));
    }
  }
  // Seen from the point, a triangle of the fan before the one below it spans all directions from the apex to
  // its own last corner, and so meets the triangles of the star up to there; those behind likewise.
  double carried = errors_[0];
  for (size_t j = 1; j + 1 < size_; ++j) {
    carried = std::max(carried, errors_[j]);
    carried_[j] = j <= over ? carried : 0;
  }
  carried = closed_ ? errors_[size_ - 1] : 0;
  for (size_t j = size_ - 2; j >= 1; --j) {
    carried = std::max(carried, errors_[j]);
    if (j >= over) carried_[j] = std::max(carried_[j], carried);
    const double gap_over = std::max({over_triangles_[j], gaps_[j], gaps_[j + 1]});
    errors_[j] = (carried_[j] + gap_over) * (1 + 1e-9) + rounding * reach_;
  }
  return true;
}

}  // namespace triptych
