// Surfaces on which error bounds are put to the test: smooth, rough, flat, thin, coloured, torn and tangled.
#pragma once

#include "tests/support/awkward_meshes.hpp"

#include <glm/geometric.hpp>
#include <string>
#include <utility>

namespace triptych::hard {

/// A square of fields² fields in two colours, cells × cells × 2 triangles.
inline Surface checkers(uint32_t cells, uint32_t fields, double height = 0) {
  Mesh mesh = awkward::grid(cells, 4, height);
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto x = static_cast<uint32_t>(i / 2 % cells), y = static_cast<uint32_t>(i / 2 / cells);
    mesh.triangles[i].material = (x * fields / cells + y * fields / cells) % 2;
  }
  return awkward::surface_of(mesh);
}

/// Every triangle a second time, the other way round.
inline Surface two_sided(Mesh mesh) {
  const size_t count = mesh.triangles.size();
  for (size_t i = 0; i < count; ++i) {
    Triangle triangle = mesh.triangles[i];
    std::swap(triangle.vertices[0], triangle.vertices[1]);
    mesh.triangles.push_back(triangle);
  }
  return awkward::surface_of(mesh);
}

/// A closed tube, bent, with thin walls if `walls`.
inline Mesh pipe(uint32_t around, uint32_t along, bool walls = false) {
  Mesh mesh{"pipe", {}, {}};
  for (const double radius : {0.5, 0.48}) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t i = 0; i <= along; ++i) {
      for (uint32_t j = 0; j < around; ++j) {
        const double bend = i * glm::pi<double>() / 2 / along, turn = j * 2 * glm::pi<double>() / around;
        const double out = 3 + radius * std::cos(turn);
        mesh.positions.push_back({out * std::cos(bend), out * std::sin(bend), radius * std::sin(turn)});
      }
    }
    for (uint32_t i = 0; i < along; ++i) {
      for (uint32_t j = 0; j < around; ++j) {
        const uint32_t a = first + i * around + j, b = first + i * around + (j + 1) % around, c = a + around,
                       d = b + around;
        mesh.triangles.push_back({{a, b, c}, 0});
        mesh.triangles.push_back({{b, d, c}, 0});
      }
    }
    if (!walls) break;
  }
  return mesh;
}

/// A box whose sides are grids.
inline Mesh fine_box(const glm::dvec3& size, uint32_t cells) {
  Mesh mesh{"fine box", {}, {}};
  const Mesh sheet = awkward::grid(cells);
  for (int side = 0; side < 6; ++side) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    for (const glm::dvec3& p : sheet.positions) {
      const glm::dvec3 at = side % 2 ? glm::dvec3{p.x, p.y, 1} : glm::dvec3{p.y, p.x, 0};
      mesh.positions.push_back(size * (side / 2 == 0   ? at
                                       : side / 2 == 1 ? glm::dvec3{at.z, at.x, at.y}
                                                       : glm::dvec3{at.y, at.z, at.x}));
    }
    for (Triangle triangle : sheet.triangles) {
      for (uint32_t& vertex : triangle.vertices) vertex += first;
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

/// A height field of noise, on which every second triangle may be turned the other way.
inline Mesh rough(uint32_t cells, bool turned) {
  Mesh mesh = awkward::grid(cells, 4, 0.5);
  std::mt19937 random(3);
  for (glm::dvec3& p : mesh.positions) p.z += static_cast<double>(random() % 1000) / 5000;
  for (Triangle& triangle : mesh.triangles) {
    if (turned && random() % 2) std::swap(triangle.vertices[0], triangle.vertices[1]);
  }
  return mesh;
}

/// Triangles between random points of a few: every kind of tangle.
inline Mesh tangle(uint32_t points, uint32_t triangles, uint32_t seed, uint32_t colors) {
  std::mt19937 random(seed);
  Mesh mesh{"tangle", {}, {}};
  for (uint32_t i = 0; i < points; ++i) {
    mesh.positions.push_back(glm::dvec3{random() % 1000, random() % 1000, random() % 1000} / 250.0);
  }
  const auto any = [&](uint32_t count) { return static_cast<uint32_t>(random() % count); };
  for (uint32_t i = 0; i < triangles; ++i) {
    const uint32_t a = any(points), b = any(points), c = any(points);
    mesh.triangles.push_back({{a, b, c}, any(colors)});
  }
  return mesh;
}

/// Boxes in rows, none of which touches another.
inline Mesh shelf(int count) {
  Mesh mesh{"shelf", {}, {}};
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 lo{i % 10, i / 10, 0};
    awkward::append(mesh, awkward::box(lo, lo + 0.5));
  }
  return mesh;
}

inline std::vector<std::pair<std::string, Surface>> surfaces() {
  using awkward::surface_of;
  Mesh spheres = awkward::sphere(8);
  for (int i = 1; i < 4; ++i) awkward::append(spheres, awkward::sphere(5, 0.5, {3 * i, 0, 0}));
  Mesh fins = awkward::grid(12, 4, 0.3);
  awkward::append(fins, awkward::book(3, 6));
  return {{"sphere", surface_of(awkward::sphere(12, 4))},
          {"spheres", surface_of(spheres)},
          {"height field", surface_of(awkward::grid(20, 4, 0.5))},
          {"rough height field", surface_of(rough(20, false))},
          {"mixed winding", surface_of(rough(16, true))},
          {"cube", surface_of(fine_box({2, 2, 2}, 8))},
          {"thin plate", surface_of(fine_box({4, 4, 0.01}, 8))},
          {"pipe", surface_of(pipe(12, 24))},
          {"pipe with walls", surface_of(pipe(10, 16, true))},
          {"checkers", checkers(16, 4)},
          {"checkers on hills", checkers(16, 4, 0.5)},
          {"two-sided hills", two_sided(awkward::grid(12, 4, 0.5))},
          {"book", surface_of(awkward::book(5, 8))},
          {"fins", surface_of(fins)},
          {"soup", surface_of(awkward::soup(200))},
          {"shelf", surface_of(shelf(30))},
          {"tangle", surface_of(tangle(60, 300, 1, 1))},
          {"coloured tangle", surface_of(tangle(80, 300, 2, 3))}};
}

}  // namespace triptych::hard
