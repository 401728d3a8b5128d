#include "simplify/cell_moves.hpp"

#include "simplify/key_hash.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

/// The sum of squared distances from planes, weighted, and from a point.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0, x = 0, y = 0, z = 0;
  glm::dvec3 weighted_points{0};
  double weight = 0;

  void add_plane(const glm::dvec3& normal, double offset, double area) {
    xx += area * normal.x * normal.x, xy += area * normal.x * normal.y, xz += area * normal.x * normal.z;
    yy += area * normal.y * normal.y, yz += area * normal.y * normal.z, zz += area * normal.z * normal.z;
    x += area * normal.x * offset, y += area * normal.y * offset, z += area * normal.z * offset;
  }
  /// The sum at p, up to a constant.
  double operator()(const glm::dvec3& p) const {
    const double planes = xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z +
                          2 * (xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z) +
                          2 * (x * p.x + y * p.y + z * p.z);
    // In flat cells every point fits equally well; there the one nearest to the middle is taken.
    const double middle = weight * glm::dot(p, p) - 2 * glm::dot(weighted_points, p);
    return planes + 0.01 * middle;
  }
};

/// A cell of the grid, and the best of its points so far.
struct Cell {
  Quadric quadric;
  double least = std::numeric_limits<double>::infinity();
  uint32_t best = 0;
  bool sunk = true;  ///< so is the best
};

/// For each point the number of its cell.
std::vector<uint32_t> cells_of(const Surface& surface, const glm::dvec3& lo, double cell) {
  tsl::robin_map<std::array<uint32_t, 3>, uint32_t, KeyHash, KeyEqual> numbers;
  numbers.reserve(surface.points.size());
  std::vector<uint32_t> cell_of;
  cell_of.reserve(surface.points.size());
  for (const glm::ivec3& point : surface.points) {
    const glm::uvec3 at((glm::dvec3(point) - lo) / cell);
    cell_of.push_back(
        numbers.try_emplace({at.x, at.y, at.z}, static_cast<uint32_t>(numbers.size())).first->second);
  }
  return cell_of;
}

/// For each point the number of its part of a cell, which planes divide in which points of the cell lie.
std::vector<uint32_t> divided(const Surface& surface, const std::vector<uint32_t>& cell_of, double cell,
                              const LayeredPlanes& layered) {
  constexpr double least_size = 2;    // cells that a plane must reach across to be kept
  constexpr size_t most_planes = 40;  // sides of so many fit a number
  tsl::robin_map<uint32_t, std::vector<uint32_t>, KeyHash> planes_in;
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    for (const uint32_t plane : layered.planes_of(i)) {
      if (layered.size_of(plane) <= least_size * cell) continue;
      std::vector<uint32_t>& planes = planes_in[cell_of[i]];
      if (planes.size() < most_planes && std::find(planes.begin(), planes.end(), plane) == planes.end())
        planes.push_back(plane);
    }
  }
  tsl::robin_map<std::array<uint32_t, 3>, uint32_t, KeyHash, KeyEqual> numbers;
  std::vector<uint32_t> part_of;
  part_of.reserve(cell_of.size());
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    uint64_t sides = 0;
    if (const auto found = planes_in.find(cell_of[i]); found != planes_in.end()) {
      for (const uint32_t plane : found->second) {
        const bool behind = layered.height(plane, surface.points[i]) < 0;
        sides = 3 * sides + (layered.is_in(i, plane) ? 0 : behind ? 1 : 2);
      }
    }
    const std::array key = {cell_of[i], static_cast<uint32_t>(sides), static_cast<uint32_t>(sides >> 32)};
    part_of.push_back(numbers.try_emplace(key, static_cast<uint32_t>(numbers.size())).first->second);
  }
  return part_of;
}

}  // namespace

TrianglePlanes::TrianglePlanes(const Surface& surface) {
  planes_.reserve(surface.triangles.size());
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.vertices;
    const glm::dvec3 origin(surface.points[a]);
    const glm::dvec3 doubled =
        glm::cross(glm::dvec3(surface.points[b]) - origin, glm::dvec3(surface.points[c]) - origin);
    const double length = glm::length(doubled);
    planes_.push_back({doubled / length, length});
  }
}

CellMoves move_to_cells(const Surface& surface, const TrianglePlanes& planes, std::span<const uint8_t> locked,
                        double cell, const LayeredPlanes& layered, std::span<const uint8_t> sunk) {
  const glm::dvec3 lo(surface.box().lo);
  std::vector<uint32_t> cell_of = cells_of(surface, lo, cell);
  if (!layered.empty()) cell_of = divided(surface, cell_of, cell, layered);
  std::vector<Cell> cells(cell_of.empty() ? 0 : *std::max_element(cell_of.begin(), cell_of.end()) + 1);
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& vertices = surface.triangles[t].vertices;
    const auto& [normal, weight] = planes[t];
    const double offset = -glm::dot(normal, glm::dvec3(surface.points[vertices[0]]) - lo);
    for (const uint32_t vertex : vertices) {
      Quadric& quadric = cells[cell_of[vertex]].quadric;
      quadric.add_plane(normal, offset, weight);
      quadric.weighted_points += (glm::dvec3(surface.points[vertex]) - lo) * weight;
      quadric.weight += weight;
    }
  }
  for (uint32_t i = 0; i < surface.points.size(); ++i) {
    Cell& own = cells[cell_of[i]];
    const double error = own.quadric(glm::dvec3(surface.points[i]) - lo);
    const bool is_sunk = !sunk.empty() && sunk[i] != 0;
    const bool is_first = !(own.least < std::numeric_limits<double>::infinity());
    if (is_first || is_sunk < own.sunk || (is_sunk == own.sunk && error < own.least)) {
      own = {own.quadric, error, i, is_sunk};
    }
  }
  CellMoves moves;
  moves.images.resize(surface.points.size());
  for (uint32_t i = 0; i < moves.images.size(); ++i) {
    moves.images[i] = !locked.empty() && locked[i] ? i : cells[cell_of[i]].best;
    moves.furthest = std::max(moves.furthest, glm::distance(glm::dvec3(surface.points[i]),
                                                            glm::dvec3(surface.points[moves.images[i]])));
    moves.planes_left = std::max(moves.planes_left, layered.left(i, moves.images[i]));
  }
  return moves;
}

}  // namespace triptych
