// What of a part's surface others may continue: its points, and the edges where it ends or folds.
#pragma once

#include "preprocess/part.hpp"
#include "scene/lattice.hpp"
#include "simplify/box_tree.hpp"
#include "simplify/component_covers.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace triptych {

struct PartRims {
  PartRims(const Part& part, const Lattice& lattice);

  std::vector<glm::dvec3> points;  ///< the part's, in the space of its lattice
  BoxTree point_tree;
  /// Edges of one triangle or of more than two, those where colours meet, and those where the surface turns
  /// by more than 30 degrees; not where the mesh was cut into parts.
  std::vector<std::array<uint32_t, 2>> edges;
  BoxTree edge_tree;
  std::vector<uint8_t> of_no_rod;  ///< for each point, whether its component is no rod (Cover::is_rod)
  /// Triangles of rods: what stands against one is left alone where a level gives it up.
  std::vector<std::array<uint32_t, 3>> sides;
  BoxTree side_tree;

  /// Of all of this in memory, roughly; bytes.
  size_t size() const { return points.size() * 120 + (edges.size() + sides.size()) * 130; }

 private:
  PartRims(const Part& part, const Lattice& lattice, const ComponentCovers& components);
};

}  // namespace triptych
