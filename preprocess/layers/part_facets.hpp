// The flat faces of a part: connected triangles of one colour in one plane.
#pragma once

#include "preprocess/part.hpp"
#include "scene/lattice.hpp"
#include "simplify/box_tree.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

struct Facet {
  glm::dvec3 point{0}, normal{0};  ///< of the plane; the normal has length 1
  Box box;
  double area = 0;
  uint32_t color = no_id;         ///< palette index; no_id where vertices have colours
  bool is_outward = false;        ///< its back cannot be seen from outside (preprocess/outward.hpp)
  uint32_t first = 0, count = 0;  ///< in PartFacets::triangles
};

/// All in the space of the part's lattice.
struct PartFacets {
  PartFacets(const Part& part, const Lattice& lattice);

  /// What the points of a facet may be off its plane, in steps of the part's lattice.
  static constexpr double flat_steps = 4;

  std::vector<glm::dvec3> points;                  ///< the part's
  std::vector<std::array<uint32_t, 3>> triangles;  ///< by facet
  std::vector<uint32_t> numbers;                   ///< of each of them, in the part
  std::vector<Facet> facets;                       ///< the one with the largest triangle first
  BoxTree tree;                                    ///< of the facets' boxes

  /// Of all of this in memory, roughly; bytes.
  size_t size() const { return points.size() * 24 + triangles.size() * 16 + facets.size() * 260; }
};

}  // namespace triptych
