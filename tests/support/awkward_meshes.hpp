// Meshes for tests: smooth ones, and those that simplifiers and partitions trip over.
#pragma once

#include "model/model.hpp"
#include "preprocess/weld.hpp"
#include "scene/lattice.hpp"
#include "simplify/surface.hpp"

#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <glm/mat4x3.hpp>
#include <random>
#include <string>
#include <vector>

namespace triptych::awkward {

/// A square of cells × cells × 2 triangles in the plane z = 0, with bumps of this height.
inline Mesh grid(uint32_t cells, double side = 1, double height = 0) {
  Mesh mesh{"grid", {}, {}};
  for (uint32_t y = 0; y <= cells; ++y) {
    for (uint32_t x = 0; x <= cells; ++x) {
      const double u = x / double(cells), v = y / double(cells);
      mesh.positions.push_back({u * side, v * side, height * std::sin(9 * u) * std::cos(7 * v)});
    }
  }
  for (uint32_t y = 0; y < cells; ++y) {
    for (uint32_t x = 0; x < cells; ++x) {
      const uint32_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.push_back({{a, b, d}, 0});
      mesh.triangles.push_back({{a, d, c}, 0});
    }
  }
  return mesh;
}

/// A closed sphere of rings × 2 rings × 2 triangles, some of them degenerate at the poles.
inline Mesh sphere(uint32_t rings, double radius = 1, const glm::dvec3& center = {}) {
  Mesh mesh{"sphere", {}, {}};
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j < 2 * rings; ++j) {
      const double polar = i * glm::pi<double>() / rings, around = j * glm::pi<double>() / rings;
      mesh.positions.push_back(center + radius * glm::dvec3{std::sin(polar) * std::cos(around),
                                                            std::cos(polar),
                                                            std::sin(polar) * std::sin(around)});
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j < 2 * rings; ++j) {
      const uint32_t next = (j + 1) % (2 * rings);
      const uint32_t a = i * 2 * rings + j, b = i * 2 * rings + next, c = a + 2 * rings, d = b + 2 * rings;
      mesh.triangles.push_back({{a, b, c}, 0});
      mesh.triangles.push_back({{b, d, c}, 0});
    }
  }
  return mesh;
}

/// Closed, and nowhere flat: a sphere of radius 10 with waves on it.
inline Mesh wavy_sphere(uint32_t rings) {
  Mesh mesh = sphere(rings, 10);
  for (glm::dvec3& position : mesh.positions) {
    const glm::dvec3 p = position;
    position *= 1 + 0.05 * std::sin(1.3 * p.x) * std::cos(1.7 * p.y) * std::sin(1.1 * p.z + 0.4);
  }
  return mesh;
}

/// Twelve triangles around an axis-aligned box.
inline Mesh box(const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material = 0) {
  Mesh mesh{"box", {}, {}};
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z});
  for (const auto& side : {std::array<uint32_t, 4>{0, 2, 3, 1},
                           {4, 5, 7, 6},
                           {0, 1, 5, 4},
                           {2, 6, 7, 3},
                           {0, 4, 6, 2},
                           {1, 3, 7, 5}}) {
    mesh.triangles.push_back({{side[0], side[1], side[2]}, material});
    mesh.triangles.push_back({{side[0], side[2], side[3]}, material});
  }
  return mesh;
}

/// Small triangles here and there in a cube of side 10; no two share a point.
inline Mesh soup(uint32_t triangles, uint32_t seed = 1) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<double>(random() % 100000) / 10000; };
  Mesh mesh{"soup", {}, {}};
  for (uint32_t i = 0; i < triangles; ++i) {
    const glm::dvec3 center{number(), number(), number()};
    for (int corner = 0; corner < 3; ++corner) {
      mesh.positions.push_back(center + 0.02 * glm::dvec3{number(), number(), number()});
    }
    mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
  }
  return mesh;
}

/// Sheets that meet in one line: more than two triangles at an edge.
inline Mesh book(uint32_t pages, uint32_t cells = 8) {
  Mesh mesh{"book", {}, {}};
  for (uint32_t page = 0; page < pages; ++page) {
    const double angle = page * 2 * glm::pi<double>() / pages;
    const Mesh sheet = grid(cells);
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : sheet.positions) {
      mesh.positions.push_back({p.x * std::cos(angle), p.x * std::sin(angle), p.y});
    }
    for (Triangle triangle : sheet.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

inline Affine translation(const glm::dvec3& by) {
  Affine transform(1);
  transform[3] = by;
  return transform;
}

inline void append(Mesh& mesh, const Mesh& other) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (Triangle triangle : other.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    mesh.triangles.push_back(triangle);
  }
}

/// A model that places each mesh once, as it is.
inline Model model_of(std::vector<Mesh> meshes) {
  Model model;
  model.materials = {Material{}, Material{{1, 0, 0, 1}}, Material{{0, 0, 1, 1}}};
  for (uint32_t i = 0; i < meshes.size(); ++i) model.instances.push_back({i, Affine(1)});
  model.meshes = std::move(meshes);
  return model;
}

/// The mesh on a lattice of a thousandth.
inline Surface surface_of(const Mesh& mesh) {
  const std::vector<uint32_t> materials = {0, 1, 2};
  return weld(mesh, Affine(1), Lattice{{0, 0, 0}, 0x1p-10}, {materials}).surface;
}

}  // namespace triptych::awkward
