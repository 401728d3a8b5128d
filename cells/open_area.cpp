#include "cells/open_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace triptych {

namespace {

using FlatPolygon = std::vector<glm::dvec2>;  ///< convex, counter-clockwise

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

double area_of(const FlatPolygon& polygon) {
  double twice = 0;
  for (size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return twice / 2;
}

FlatRectangle around(std::span<const glm::dvec2> points) {
  FlatRectangle box{points[0], points[0]};
  for (const glm::dvec2& point : points) {
    box.lo = glm::min(box.lo, point);
    box.hi = glm::max(box.hi, point);
  }
  return box;
}

FlatRectangle around(const FlatRectangle& a, const FlatRectangle& b) {
  return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

bool meet(const FlatRectangle& a, const FlatRectangle& b) {
  return a.lo.x < b.hi.x && b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
}

double area_of(const FlatRectangle& box) { return box.size().x * box.size().y; }

/// The part to the left of the line from `a` towards `b`, moved to the right by `reach`; and the other one.
void split(const FlatPolygon& polygon, const glm::dvec2& a, const glm::dvec2& b, double reach,
           FlatPolygon& left, FlatPolygon& right) {
  left.clear();
  right.clear();
  const glm::dvec2 side = b - a;
  const double length = std::hypot(side.x, side.y);
  const auto height = [&](const glm::dvec2& point) { return cross(side, point - a) / length + reach; };
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &here = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double at_here = height(here), at_next = height(next);
    if (at_here >= 0) left.push_back(here);
    if (at_here <= 0) right.push_back(here);
    if ((at_here < 0 && at_next > 0) || (at_here > 0 && at_next < 0)) {
      const glm::dvec2 between = here + (next - here) * (at_here / (at_here - at_next));
      left.push_back(between);
      right.push_back(between);
    }
  }
}

/// How wide a convex polygon is at most, across its longest side or more.
double width_of(const FlatPolygon& polygon) {
  double longest = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 side = polygon[(i + 1) % polygon.size()] - polygon[i];
    longest = std::max(longest, std::hypot(side.x, side.y));
  }
  return longest > 0 ? 2 * area_of(polygon) / longest : 0;
}

/// What is left of a polygon without the triangle, which is taken to reach `least` further.
void take_away(const FlatPolygon& from, const WallTriangle& triangle, double least,
               std::vector<FlatPolygon>& left) {
  FlatPolygon rest = from, inside, outside;
  for (size_t k = 0; k < 3 && rest.size() >= 3; ++k) {
    split(rest, triangle.corners[k], triangle.corners[(k + 1) % 3], least, inside, outside);
    if (outside.size() >= 3 && width_of(outside) > least) left.push_back(outside);
    std::swap(rest, inside);
  }
}

/// Joins rectangles where that adds little to what they hold.
void join(std::vector<FlatRectangle>& boxes) {
  constexpr double most_more = 1.01;
  constexpr size_t many = 512;
  if (boxes.size() > many) {
    FlatRectangle all = boxes.front();
    for (const FlatRectangle& box : boxes) all = around(all, box);
    boxes.assign(1, all);
    return;
  }
  for (bool again = true; again;) {
    again = false;
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (size_t k = i + 1; k < boxes.size(); ++k) {
        const FlatRectangle both = around(boxes[i], boxes[k]);
        const double apart = area_of(boxes[i]) + area_of(boxes[k]);
        const bool overlap = meet(boxes[i], boxes[k]);
        if (area_of(both) > (overlap ? 1.5 : most_more) * apart) continue;
        boxes[i] = both;
        boxes[k] = boxes.back();
        boxes.pop_back();
        again = true;
        --k;
      }
    }
  }
}

}  // namespace

std::vector<FlatRectangle> open_area(const FlatRectangle& of, std::span<const WallTriangle> triangles,
                                     double least) {
  constexpr size_t most_pieces = 4096;
  std::vector<FlatPolygon> left{{of.lo, {of.hi.x, of.lo.y}, of.hi, {of.lo.x, of.hi.y}}};
  std::vector<FlatPolygon> next;
  for (const WallTriangle& triangle : triangles) {
    const FlatRectangle box = around(triangle.corners);
    if (!meet(box, of)) continue;
    next.clear();
    for (FlatPolygon& polygon : left) {
      if (meet(around(polygon), box)) {
        take_away(polygon, triangle, least, next);
      } else {
        next.push_back(std::move(polygon));
      }
    }
    std::swap(left, next);
    if (left.size() > most_pieces) break;  // what is left holds what further triangles would leave
  }
  std::vector<FlatRectangle> boxes;
  for (const FlatPolygon& polygon : left) {  // with what triangles were taken to reach further
    const FlatRectangle box = around(polygon);
    boxes.push_back({glm::max(box.lo - least, of.lo), glm::min(box.hi + least, of.hi)});
  }
  join(boxes);
  return boxes;
}

double covered_area(const FlatRectangle& of, std::span<const WallTriangle> triangles) {
  double area = 0;
  FlatPolygon inside, outside;
  const std::array<glm::dvec2, 4> corners = {of.lo, glm::dvec2(of.hi.x, of.lo.y), of.hi,
                                             glm::dvec2(of.lo.x, of.hi.y)};
  for (const WallTriangle& triangle : triangles) {
    const FlatRectangle box = around(triangle.corners);
    if (!meet(box, of)) continue;
    FlatPolygon rest(triangle.corners.begin(), triangle.corners.end());
    for (size_t k = 0; k < 4 && rest.size() >= 3; ++k) {
      split(rest, corners[k], corners[(k + 1) % 4], 0, inside, outside);
      std::swap(rest, inside);
    }
    if (rest.size() >= 3) area += area_of(rest);
  }
  return area;
}

}  // namespace triptych
