// Curves of DXF that are surfaces, since they have a thickness (walls along the extrusion direction) or a
// width.
#include "model/import/import_dxf.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>

namespace triptych {

namespace {

/// The largest angle that one chord of an arc spans.
constexpr double max_chord_angle = std::numbers::pi / 32;

/// A point of a curve on its plane, and the widths of what begins there.
struct CurvePoint {
  glm::dvec2 at{0};
  double start_width = 0, end_width = 0;
  double bulge = 0;  ///< tangent of a quarter of the angle of the arc to the next point
};

/// A curve of straight pieces; the widths are those of the piece that begins at a point.
struct Curve {
  std::vector<CurvePoint> points;
  bool closed = false;
  double elevation = 0, thickness = 0;
  Affine axes{1};

  size_t pieces() const { return closed ? points.size() : points.size() - 1; }
  glm::dvec3 place(const glm::dvec2& at, double height) const {
    return axes * glm::dvec4(at, elevation + height, 1);
  }
};

/// Adds the points of the arc from a to b, without b; widths go over in equal steps.
void add_arc(const CurvePoint& a, const CurvePoint& b, std::vector<CurvePoint>& points) {
  const double angle = 4 * std::atan(a.bulge);
  const glm::dvec2 chord = b.at - a.at;
  const glm::dvec2 centre =
      (a.at + b.at) / 2.0 + glm::dvec2(-chord.y, chord.x) * (1 / std::tan(angle / 2) / 2);
  const auto count = std::max(1, static_cast<int>(std::ceil(std::abs(angle) / max_chord_angle)));
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / count, next = static_cast<double>(i + 1) / count;
    const double s = std::sin(angle * share), c = std::cos(angle * share);
    const glm::dvec2 from = a.at - centre;
    const auto width = [&](double at) { return a.start_width + (a.end_width - a.start_width) * at; };
    points.push_back({i == 0 ? a.at : centre + glm::dvec2(from.x * c - from.y * s, from.x * s + from.y * c),
                      width(share), width(next), 0});
  }
}

/// Without arcs and without pieces of no length.
Curve straightened(Curve curve) {
  std::vector<CurvePoint> given = std::move(curve.points);
  curve.points.clear();
  for (size_t i = 0; i < given.size(); ++i) {
    const bool last = i + 1 == given.size();
    if (last && !curve.closed) {
      curve.points.push_back(given[i]);
      break;
    }
    const CurvePoint& next = given[last ? 0 : i + 1];
    if (next.at == given[i].at) continue;
    if (given[i].bulge != 0 && std::isfinite(given[i].bulge)) {
      add_arc(given[i], next, curve.points);
    } else {
      curve.points.push_back(given[i]);
    }
  }
  return curve;
}

/// Walls: each piece of the curve, drawn along its extrusion direction.
void add_walls(const Curve& curve, const DxfStyle& style, DxfSurfaces& surfaces) {
  for (size_t i = 0; i < curve.pieces(); ++i) {
    const glm::dvec2 &a = curve.points[i].at, &b = curve.points[(i + 1) % curve.points.size()].at;
    surfaces.add_face(std::array{curve.place(a, 0), curve.place(b, 0), curve.place(b, curve.thickness),
                                 curve.place(a, curve.thickness)},
                      style);
  }
}

glm::dvec2 left_of(const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = glm::normalize(b - a);
  return {-along.y, along.x};
}

/// Which way the edge of a wide curve lies from a point, for a width of 2: mitred where two pieces meet.
glm::dvec2 mitre(const glm::dvec2& before, const glm::dvec2& after) {
  const glm::dvec2 sum = before + after;
  constexpr double sharpest = 0.5;  // of the sum's squared length; sharper corners are not mitred
  return glm::dot(sum, sum) < sharpest ? after : sum * (2 / glm::dot(sum, sum));
}

/// A band of its widths, and with a thickness a solid: top, bottom and both sides of each piece.
void add_band(const Curve& curve, const DxfStyle& style, DxfSurfaces& surfaces) {
  const size_t count = curve.points.size();
  std::vector<glm::dvec2> lefts;
  for (size_t i = 0; i < curve.pieces(); ++i)
    lefts.push_back(left_of(curve.points[i].at, curve.points[(i + 1) % count].at));
  for (size_t i = 0; i < curve.pieces(); ++i) {
    const CurvePoint &a = curve.points[i], &b = curve.points[(i + 1) % count];
    const bool has_before = i > 0 || curve.closed, has_after = i + 1 < curve.pieces() || curve.closed;
    const glm::dvec2& before = lefts[(i + lefts.size() - 1) % lefts.size()];
    const glm::dvec2& after = lefts[(i + 1) % lefts.size()];
    const glm::dvec2 at_a = (has_before ? mitre(before, lefts[i]) : lefts[i]) * (a.start_width / 2);
    // A sharp corner: each piece ends at right angles.
    const glm::dvec2 joined = has_after ? mitre(after, lefts[i]) : lefts[i];
    const glm::dvec2 at_b = joined * (a.end_width / 2);
    const std::array<glm::dvec2, 4> outline = {a.at - at_a, b.at - at_b, b.at + at_b, a.at + at_a};
    std::array<glm::dvec3, 4> bottom, top;
    for (size_t k = 0; k < 4; ++k) {
      bottom[k] = curve.place(outline[k], 0);
      top[k] = curve.place(outline[k], curve.thickness);
    }
    surfaces.add_face(bottom, style);
    if (curve.thickness == 0) continue;
    surfaces.add_face(top, style);
    for (size_t k = 0; k < 4; ++k) {
      const bool between_pieces = (k == 1 && has_after) || (k == 3 && has_before);
      if (!between_pieces)
        surfaces.add_face(std::array{bottom[k], bottom[(k + 1) % 4], top[(k + 1) % 4], top[k]}, style);
    }
  }
}

bool add_curve(Curve given, const DxfStyle& style, DxfSurfaces& surfaces) {
  const bool wide = std::any_of(given.points.begin(), given.points.end(), [](const CurvePoint& point) {
    return point.start_width > 0 || point.end_width > 0;
  });
  if (!wide && given.thickness == 0) return false;
  const Curve curve = straightened(std::move(given));
  if (curve.points.size() < 2) return true;
  wide ? add_band(curve, style, surfaces) : add_walls(curve, style, surfaces);
  return true;
}

Curve read_lwpolyline(const DxfRecord& entity) {
  Curve curve;
  curve.elevation = entity.number(38);
  const double width = entity.number(43);
  for (const DxfGroup& group : entity.groups) {
    if (group.code == 10) {
      curve.points.push_back({{group.number, 0}, width, width, 0});
      continue;
    }
    if (curve.points.empty()) continue;
    CurvePoint& point = curve.points.back();
    if (group.code == 20) point.at.y = group.number;
    if (group.code == 40) point.start_width = group.number;
    if (group.code == 41) point.end_width = group.number;
    if (group.code == 42) point.bulge = group.number;
  }
  return curve;
}

Curve read_polyline(const DxfRecord& entity, std::span<const DxfRecord> vertices) {
  constexpr int64_t control_point = 16;
  Curve curve;
  curve.elevation = entity.number(30);
  for (const DxfRecord& vertex : vertices) {
    if ((vertex.integer(70) & control_point) != 0) continue;
    curve.points.push_back({{vertex.coordinate(10), vertex.coordinate(20)},
                            vertex.number(40, entity.number(40)),
                            vertex.number(41, entity.number(41)),
                            vertex.number(42)});
  }
  return curve;
}

/// An arc of a circle, counter-clockwise, angles in radians.
std::vector<CurvePoint> arc_points(const glm::dvec2& centre, double radius, double from, double to,
                                   bool whole) {
  const auto count = std::max(1, static_cast<int>(std::ceil((to - from) / max_chord_angle)));
  std::vector<CurvePoint> points;
  for (int i = 0; i < count + (whole ? 0 : 1); ++i) {
    const double angle = from + (to - from) * i / count;
    points.push_back({centre + radius * glm::dvec2(std::cos(angle), std::sin(angle))});
  }
  return points;
}

/// A circle of a thickness is a cylinder with its lids; an arc is a wall.
bool add_round(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  const bool whole = entity.type == "CIRCLE";
  constexpr double full_turn = 2 * std::numbers::pi;
  double from = 0, to = full_turn;
  if (!whole) {
    from = glm::radians(entity.number(50)), to = glm::radians(entity.number(51));
    to = from + std::fmod(to - from, full_turn);
    if (to <= from) to += full_turn;
  }
  Curve curve;
  curve.closed = whole;
  curve.elevation = entity.number(30);
  curve.thickness = entity.number(39);
  curve.axes = dxf_object_axes(entity);
  curve.points =
      arc_points({entity.coordinate(10), entity.coordinate(20)}, entity.number(40), from, to, whole);
  if (curve.thickness == 0) return false;
  add_walls(curve, style, surfaces);
  if (!whole) return true;
  for (const double height : {0.0, curve.thickness}) {
    std::vector<glm::dvec3> lid;
    for (const CurvePoint& point : curve.points) lid.push_back(curve.place(point.at, height));
    surfaces.add_face(lid, style);
  }
  return true;
}

bool add_line(const DxfRecord& entity, const DxfStyle& style, DxfSurfaces& surfaces) {
  if (entity.number(39) == 0) return false;
  const glm::dvec3 up = dxf_object_axes(entity)[2] * entity.number(39);
  const glm::dvec3 a(entity.coordinate(10), entity.coordinate(20), entity.coordinate(30));
  const glm::dvec3 b(entity.coordinate(11), entity.coordinate(21), entity.coordinate(31));
  surfaces.add_face(std::array{a, b, b + up, a + up}, style);
  return true;
}

}  // namespace

bool add_dxf_curve(const DxfRecord& entity, std::span<const DxfRecord> vertices, const DxfStyle& style,
                   DxfSurfaces& surfaces) {
  constexpr int64_t closed = 1, in_space = 8;
  if (entity.type == "LINE") return add_line(entity, style, surfaces);
  if (entity.type == "CIRCLE" || entity.type == "ARC") return add_round(entity, style, surfaces);
  if (entity.type != "LWPOLYLINE" && entity.type != "POLYLINE") return false;
  const int64_t flags = entity.integer(70);
  if (entity.type == "POLYLINE" && (flags & in_space) != 0) return false;
  Curve curve = entity.type == "POLYLINE" ? read_polyline(entity, vertices) : read_lwpolyline(entity);
  curve.closed = (flags & closed) != 0;
  curve.thickness = entity.number(39);
  curve.axes = dxf_object_axes(entity);
  if (curve.points.empty()) return false;
  return add_curve(std::move(curve), style, surfaces);
}

}  // namespace triptych
