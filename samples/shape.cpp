#include "samples/shape.hpp"

#include "samples/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace triptych {
namespace {

constexpr size_t min_sides = 5, max_sides = 160, box_triangles = 12, bolt_triangles = 20, bolt_corners = 12;

/// Arc steps of a bend. More sides, smoother bends.
size_t bend_steps(size_t sides) { return std::clamp<size_t>(sides / 4, 2, 12); }

/// Rings that a round part cannot do without.
size_t min_rings(size_t points, bool bent, size_t sides) {
  return bent ? 2 + (points - 2) * (bend_steps(sides) + 1) : points;
}

uint64_t round_triangles(size_t sides, size_t rings) { return 2 * sides * (rings - 1) + 2 * (sides - 2); }

/// A tube's line with its corners cut into arcs.
std::vector<Ring> bent_rings(const std::vector<glm::dvec3>& points, double radius, size_t steps) {
  std::vector<Ring> rings{{points.front(), radius}};
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const glm::dvec3 before = points[i - 1] - points[i], after = points[i + 1] - points[i];
    const double reach = std::min({2.5 * radius, 0.45 * glm::length(before), 0.45 * glm::length(after)});
    const glm::dvec3 a = glm::normalize(before) * reach, b = glm::normalize(after) * reach;
    // For a right angle, a quarter circle; for other bends, a curve close to one.
    for (size_t k = 0; k <= steps; ++k) {
      const double turn = glm::half_pi<double>() * static_cast<double>(k) / static_cast<double>(steps);
      rings.push_back({points[i] + a * (1 - std::sin(turn)) + b * (1 - std::cos(turn)), radius});
    }
  }
  rings.push_back({points.back(), radius});
  return rings;
}

/// Adds rings between others, evenly by length.
std::vector<Ring> with_more(const std::vector<Ring>& rings, size_t more) {
  double length = 0;
  for (size_t i = 1; i < rings.size(); ++i) length += glm::distance(rings[i - 1].centre, rings[i].centre);
  std::vector<Ring> result{rings.front()};
  double passed = 0;
  size_t added = 0;
  for (size_t i = 1; i < rings.size(); ++i) {
    passed += glm::distance(rings[i - 1].centre, rings[i].centre);
    const auto goal = i + 1 == rings.size() || length <= 0
                          ? more
                          : static_cast<size_t>(static_cast<double>(more) * passed / length);
    const size_t here = goal - added;
    for (size_t k = 1; k <= here; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(here + 1);
      result.push_back({glm::mix(rings[i - 1].centre, rings[i].centre, t),
                        glm::mix(rings[i - 1].radius, rings[i].radius, t)});
    }
    added = goal;
    result.push_back(rings[i]);
  }
  return result;
}

}  // namespace

/// How many of the parts there will be, and how fine each is.
struct Shape::Plan {
  size_t parts = 0;
  std::vector<size_t> sides, rings;  ///< 0 for bars
  uint64_t triangles = 0, vertices = 0;
};

void Shape::box(const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 middle = 0.5 * (low + high);
  bar({low.x, middle.y, middle.z}, {high.x, middle.y, middle.z}, high.z - low.z, high.y - low.y);
}

void Shape::bar(const glm::dvec3& from, const glm::dvec3& to, double width, double height,
                const glm::dvec3& side) {
  const glm::dvec3 along = glm::normalize(to - from);
  const glm::dvec3 u = glm::normalize(side - along * glm::dot(side, along)) * (width / 2);
  const glm::dvec3 v = glm::cross(along, glm::normalize(u)) * (height / 2);
  parts_.push_back({{from - u - v, from + u - v, from + u + v, from - u + v, to - u - v, to + u - v,
                     to + u + v, to - u + v},
                    {},
                    false});
}

void Shape::bolt(const glm::dvec3& place, double radius, double height) {
  Part part;
  for (const double up : {0.0, height}) {
    for (int k = 0; k < 6; ++k) {
      const double turn = -glm::two_pi<double>() * k / 6;
      part.points.push_back(place + glm::dvec3(radius * std::cos(turn), up, radius * std::sin(turn)));
    }
  }
  parts_.push_back(std::move(part));
}

void Shape::tube(std::vector<glm::dvec3> line, double radius) {
  std::vector<double> radii(line.size(), radius);
  parts_.push_back({std::move(line), std::move(radii), true});
}

void Shape::turned(const glm::dvec3& base, int axis, const std::vector<glm::dvec2>& profile) {
  Part part;
  for (const glm::dvec2& step : profile) {
    glm::dvec3 centre = base;
    centre[axis] += step.x;
    part.points.push_back(centre);
    part.radii.push_back(step.y);
  }
  parts_.push_back(std::move(part));
}

void Shape::cylinder(const glm::dvec3& base, int axis, double length, double radius) {
  turned(base, axis, {{0, radius}, {length, radius}});
}

Shape::Plan Shape::plan_for(uint64_t triangles) const {
  const auto fixed = [](const Part& part) {
    return part.points.size() == bolt_corners ? bolt_triangles : box_triangles;
  };
  Plan plan;
  uint64_t least = 0, bars = 0;
  for (const Part& part : parts_) {
    const uint64_t needed =
        part.radii.empty() ? fixed(part)
                           : round_triangles(min_sides, min_rings(part.points.size(), part.bent, min_sides));
    if (plan.parts > 0 && least + needed > triangles) break;
    least += needed;
    if (part.radii.empty()) bars += needed;
    ++plan.parts;
  }
  plan.sides.resize(plan.parts);
  plan.rings.resize(plan.parts);
  // The finest edge that the triangles allow.
  const auto count_at = [&](double edge) {
    uint64_t count = bars;
    for (size_t i = 0; i < plan.parts; ++i) {
      const Part& part = parts_[i];
      if (part.radii.empty()) continue;
      const double around = glm::two_pi<double>() * *std::max_element(part.radii.begin(), part.radii.end());
      double length = 0;
      for (size_t k = 1; k < part.points.size(); ++k)
        length += glm::distance(part.points[k - 1], part.points[k]);
      plan.sides[i] = static_cast<size_t>(
          std::clamp(around / edge, static_cast<double>(min_sides), static_cast<double>(max_sides)));
      constexpr double stretch = 6;  // along a pipe triangles may be longer
      plan.rings[i] = std::max(min_rings(part.points.size(), part.bent, plan.sides[i]),
                               static_cast<size_t>(length / (stretch * edge)));
      count += round_triangles(plan.sides[i], plan.rings[i]);
    }
    return count;
  };
  double coarse = 1e3, fine = 1e-4;
  for (int step = 0; step < 32; ++step) {
    const double edge = std::sqrt(coarse * fine);
    (count_at(edge) <= triangles ? coarse : fine) = edge;
  }
  plan.triangles = count_at(coarse);
  // What is left becomes more rings, shared out in proportion.
  const double left = triangles > plan.triangles ? static_cast<double>(triangles - plan.triangles) : 0;
  const auto round = static_cast<double>(std::max<uint64_t>(plan.triangles - bars, 1));
  double owed = 0;
  for (size_t i = 0; i < plan.parts; ++i) {
    if (parts_[i].radii.empty()) {
      plan.vertices += parts_[i].points.size();
      continue;
    }
    const auto ring = static_cast<double>(2 * plan.sides[i]);
    owed += left * static_cast<double>(round_triangles(plan.sides[i], plan.rings[i])) / round;
    const double more = std::floor(owed / ring);
    owed -= more * ring;
    plan.rings[i] += static_cast<size_t>(more);
    plan.triangles += static_cast<uint64_t>(more * ring);
    plan.vertices += plan.sides[i] * plan.rings[i];
  }
  return plan;
}

MeshPart Shape::mesh(uint64_t triangles) const {
  const Plan plan = plan_for(triangles);
  MeshPart mesh;
  mesh.colour = colour_;
  mesh.positions.reserve(plan.vertices);
  mesh.indices.reserve(3 * plan.triangles);
  for (size_t i = 0; i < plan.parts; ++i) {
    const Part& part = parts_[i];
    if (part.radii.empty()) {
      const auto middle = part.points.begin() + static_cast<std::ptrdiff_t>(part.points.size() / 2);
      add_lofted(mesh, {{part.points.begin(), middle}, {middle, part.points.end()}});
      continue;
    }
    std::vector<Ring> rings;
    if (part.bent) {
      rings = bent_rings(part.points, part.radii.front(), bend_steps(plan.sides[i]));
    } else {
      for (size_t k = 0; k < part.points.size(); ++k) rings.push_back({part.points[k], part.radii[k]});
    }
    add_round(mesh, with_more(rings, plan.rings[i] - rings.size()), plan.sides[i]);
  }
  return mesh;
}

}  // namespace triptych
