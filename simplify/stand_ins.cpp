#include "simplify/stand_ins.hpp"

#include "simplify/component_covers.hpp"
#include "simplify/distance.hpp"
#include "simplify/key_hash.hpp"
#include "simplify/stand_in_candidates.hpp"
#include "simplify/stand_in_shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

constexpr double rounding = in_plane_rounding;
/// What is so many times as long as it is wide is a rod.
constexpr double rod = 3;
/// How near bounds are to the true distance.
constexpr double tightness = 1.1;
/// What is not long is shown a little smaller than it is: what of a stand-in goes beyond it, and shows where
/// nothing was, is less by more than what it then lacks.
constexpr double cover_of_compact = 0.92;
/// Of its shapes whose distances differ by less than this factor the one whose outlines are nearest is taken.
constexpr double about_as_near = 1.25;

/// The component's own axes, and how far it reaches along them.
struct Frame {
  glm::dvec3 middle{0};
  std::array<glm::dvec3, 3> axes;  ///< of length 1
  glm::dvec3 reach{0};
};

Frame frame_of(const Surface& component, const std::optional<StandInBase>& base) {
  glm::dvec3 mean(0);
  double area = 0;
  const auto each = [&](const auto& take) {
    for (const Triangle& triangle : component.triangles) {
      std::array<glm::dvec3, 3> corners;
      for (size_t k = 0; k < 3; ++k) corners[k] = component.points[triangle.vertices[k]];
      take(corners, glm::length(area_normal(corners[0], corners[1], corners[2])));
    }
  };
  each([&](const auto& corners, double own) {
    mean += own * (corners[0] + corners[1] + corners[2]) / 3.0;
    area += own;
  });
  mean /= area;
  std::array<glm::dvec3, 3> covariance = {};
  each([&](const auto& corners, double own) {
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec3 way = (corners[k] + corners[(k + 1) % 3]) / 2.0 - mean;  // exact for second moments
      for (int axis = 0; axis < 3; ++axis) covariance[axis] += own * way[axis] * way;
    }
  });
  if (base) {  // only what lies across varies
    const glm::dvec3 n = base->inward;
    const auto across = [&](const glm::dvec3& way) { return way - n * glm::dot(way, n); };
    const glm::dvec3 of_n = covariance[0] * n.x + covariance[1] * n.y + covariance[2] * n.z;
    std::array<glm::dvec3, 3> flat;
    for (int axis = 0; axis < 3; ++axis) flat[axis] = across(covariance[axis] - of_n * n[axis]);
    covariance = flat;
  }
  Frame frame{.axes = principal_axes(covariance)};
  if (base) {
    std::ranges::sort(frame.axes, {},
                      [&](const glm::dvec3& axis) { return std::abs(glm::dot(axis, base->inward)); });
    frame.axes[2] = base->inward;
    frame.axes[0] = glm::normalize(frame.axes[0] - base->inward * glm::dot(frame.axes[0], base->inward));
    frame.axes[1] = glm::cross(frame.axes[2], frame.axes[0]);
  }
  glm::dvec3 low(1e300), high(-1e300);
  for (const glm::ivec3& point : component.points) {
    for (int axis = 0; axis < 3; ++axis) {
      const double along = glm::dot(glm::dvec3(point) - mean, frame.axes[axis]);
      low[axis] = std::min(low[axis], along);
      high[axis] = std::max(high[axis], along);
    }
  }
  frame.middle = mean;
  for (int axis = 0; axis < 3; ++axis) frame.middle += frame.axes[axis] * (low[axis] + high[axis]) / 2.0;
  frame.reach = (high - low) / 2.0;
  return frame;
}

/// Points of the surface for those of a stand-in: near ones that are not locked, none twice where there are
/// enough.
std::vector<uint32_t> sources_for(const std::vector<glm::ivec3>& points, const StandInComponent& of) {
  const Piece& component = of.piece;
  std::vector<uint32_t> sources;
  for (const glm::ivec3& point : points) {
    double least = 1e300;
    uint32_t best = component.sources[0];
    for (size_t i = 0; i < component.sources.size(); ++i) {
      const double distance = glm::distance(glm::dvec3(point), glm::dvec3(component.surface.points[i]));
      if (of.locked[i] && points.size() < component.sources.size()) continue;
      if (distance >= least || std::ranges::find(sources, component.sources[i]) != sources.end()) continue;
      least = distance;
      best = component.sources[i];
    }
    sources.push_back(best);
  }
  return sources;
}

/// What a stand-in's triangle is drawn as: like the component's triangle in whose plane it lies.
uint32_t material_of(const std::array<glm::dvec3, 3>& corners, const StandInComponent& of) {
  const Piece& component = of.piece;
  const glm::dvec3 normal =
      glm::cross(corners[1] - corners[0], corners[2] - corners[0]) * (of.is_inside_out ? -1.0 : 1.0);
  for (const Triangle& triangle : component.surface.triangles) {
    const auto& points = component.surface.points;
    const glm::ivec3 first = points[triangle.vertices[0]];
    const glm::dvec3 own =
        glm::normalize(area_normal(first, points[triangle.vertices[1]], points[triangle.vertices[2]]));
    const bool in_plane = std::ranges::all_of(corners, [&](const glm::dvec3& corner) {
      return std::abs(glm::dot(corner - glm::dvec3(first), own)) <= rounding;
    });
    if (in_plane && glm::dot(own, normal) > 0) return triangle.material;
  }
  return palette_index(component.surface.triangles[0].material);
}

std::optional<Piece> placed(const StandInShape& shape, const Frame& frame, const std::array<int, 3>& order,
                            const glm::dvec3& scale, const StandInComponent& component) {
  // The shape's x, y, z lie along these axes; together they must turn to the right.
  std::array<glm::dvec3, 3> axes;
  for (size_t k = 0; k < 3; ++k) axes[k] = frame.axes[order[k]];
  if (glm::dot(glm::cross(axes[0], axes[1]), axes[2]) < 0) axes[0] = -axes[0];
  Piece piece;
  for (const glm::dvec3& corner : shape.corners) {
    glm::dvec3 point = frame.middle;
    for (int k = 0; k < 3; ++k) point += axes[k] * corner[k] * scale[k];
    piece.surface.points.emplace_back(glm::round(point));
  }
  for (const auto& [a, b, c] : shape.triangles) {
    const auto& points = piece.surface.points;
    if (degenerate(points[a], points[b], points[c])) return std::nullopt;
    const std::array<glm::dvec3, 3> corners = {points[a], points[b], points[c]};
    const uint32_t second = component.is_inside_out ? c : b, third = component.is_inside_out ? b : c;
    piece.surface.triangles.push_back({{a, second, third}, material_of(corners, component)});
  }
  piece.sources = sources_for(piece.surface.points, component);
  return piece;
}

/// Shapes, and the axes along which they may stand.
struct Shapes {
  std::vector<StandInShape> shapes;
  std::vector<std::array<int, 3>> orders;
  double cover = 1;     ///< of what the component covers
  double as_near = 1;   ///< factor of distances, up to which outlines decide
  bool in_all = false;  ///< scaled along z, too
};

/// The nearest shape along whichever axis that is.
std::optional<StandIn> nearest(const Shapes& shapes, const StandInComponent& component, const Frame& frame,
                               double area, DistanceMeter& meter, double max_bound) {
  std::vector<StandIn> candidates;
  double least = max_bound;
  for (const std::array<int, 3>& order : shapes.orders) {
    const glm::dvec3 reach(frame.reach[order[0]], frame.reach[order[1]], frame.reach[order[2]]);
    for (const StandInShape& shape : shapes.shapes) {
      if (shape.triangles.size() >= component.piece.surface.triangles.size()) continue;
      const double factor = scale_for(shape, reach, shapes.in_all, area * shapes.cover);
      if (factor < 0) continue;
      const double along = shapes.in_all ? reach.z * factor : reach.z;
      auto piece = placed(shape, frame, order, {reach.x * factor, reach.y * factor, along}, component);
      if (!piece) continue;
      const double bound = meter.bound(piece->surface, {.tightness = tightness});
      if (bound >= max_bound) continue;
      least = std::min(least, bound);
      candidates.push_back({std::move(*piece), bound});
    }
  }
  std::optional<StandIn> best;
  double difference = 1e300;
  for (StandIn& candidate : candidates) {
    if (candidate.bound > shapes.as_near * least) continue;
    const double own = mean_difference(candidate.piece.surface.points, component.piece.surface.points);
    if (own >= difference) continue;
    difference = own;
    best = std::move(candidate);
  }
  return best;
}

/// With fewer and fewer triangles. Prisms are for what is like a box, antiprisms for what is round. Four
/// sides are nearer than three, but from some directions two fifths wider than from others, three sides a
/// sixth: of rods side by side that shows. Three sides are thin in their middle, which shows where a sleeve
/// is around something.
std::vector<Shapes> shapes_for(bool stands, bool is_rod) {
  constexpr double quarter = std::numbers::pi / 2;
  const std::vector<std::array<int, 3>> up = {{0, 1, 2}}, any = {{1, 2, 0}, {0, 2, 1}, {0, 1, 2}};
  if (!is_rod)
    return {{.shapes = {prism(4, quarter / 2), antiprism(4, quarter / 2)},
             .orders = stands ? up : any,
             .cover = cover_of_compact,
             .as_near = about_as_near}};
  if (stands) return {};
  return {{.shapes = {prism(3, 0), prism(3, quarter)}, .orders = any},
          {.shapes = {tetrahedron()}, .orders = any}};
}

std::vector<StandIn> stand_ins_of(const StandInComponent& component, double max_bound) {
  const Surface& surface = component.piece.surface;
  const Frame frame = frame_of(surface, component.base);
  double area = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    area += glm::length(area_normal(surface.points[a], surface.points[b], surface.points[c]));
  }
  DistanceMeter meter(surface, Colors::ignore);
  std::vector<StandIn> found;
  std::array<double, 3> reach = {frame.reach.x, frame.reach.y, frame.reach.z};
  std::ranges::sort(reach);
  for (const Shapes& shapes : shapes_for(component.base.has_value(), reach[2] > rod * reach[1])) {
    auto next = nearest(shapes, component, frame, area, meter, max_bound);
    if (!next) continue;
    while (!found.empty() && found.back().bound >= next->bound) found.pop_back();
    found.push_back(std::move(*next));
  }
  return found;
}

/// The same stand-ins, for a component that is the other one moved.
std::vector<StandIn> moved(std::vector<StandIn> stand_ins, const Piece& from, const Piece& to) {
  tsl::robin_map<uint32_t, uint32_t, KeyHash> twins;
  for (size_t i = 0; i < from.sources.size(); ++i) twins.insert({from.sources[i], to.sources[i]});
  for (StandIn& stand_in : stand_ins) {
    for (uint32_t& source : stand_in.piece.sources) source = twins.at(source);
    for (glm::ivec3& point : stand_in.piece.surface.points)
      point += to.surface.points[0] - from.surface.points[0];
    for (Triangle& triangle : stand_in.piece.surface.triangles) {
      const uint32_t own = palette_index(triangle.material);
      triangle.material += palette_index(to.surface.triangles[0].material) - own;
    }
  }
  return stand_ins;
}

}  // namespace

std::vector<ConvexComponent> convex_components(const Surface& surface, std::span<const uint8_t> locked,
                                               double max_bound, size_t least) {
  std::vector<StandInCandidate> candidates = stand_in_candidates(surface, locked, least);
  std::vector<ConvexComponent> found(candidates.size());
  for (size_t i = 0; i < candidates.size(); ++i) {
    StandInCandidate& own = candidates[i];
    if (!own.is_convex) continue;
    const StandInCandidate& like = candidates[own.like];
    found[i].triangles = std::move(own.triangles);
    found[i].stand_ins = own.like == i
                             ? stand_ins_of(own.component, max_bound)
                             : moved(found[own.like].stand_ins, like.component.piece, own.component.piece);
  }
  std::erase_if(found, [](const ConvexComponent& component) { return component.stand_ins.empty(); });
  return found;
}

}  // namespace triptych
