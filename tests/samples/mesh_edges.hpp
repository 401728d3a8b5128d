// What tests ask of an indexed mesh: its edges, its volume, its pieces.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace triptych {

using Faces = std::vector<std::array<uint32_t, 3>>;
using Edge = std::pair<uint32_t, uint32_t>;

/// How often each edge is run through in each direction: forwards is from the lower number to the higher.
struct EdgeUse {
  int forwards = 0, backwards = 0;
};

inline std::map<Edge, EdgeUse> edges_of(const Faces& faces) {
  std::map<Edge, EdgeUse> edges;
  for (const auto& face : faces) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = face[i], b = face[(i + 1) % 3];
      if (a < b) {
        ++edges[{a, b}].forwards;
      } else {
        ++edges[{b, a}].backwards;
      }
    }
  }
  return edges;
}

/// Positive if a closed mesh looks outwards.
template <typename Positions>
double volume_of(const Positions& positions, const Faces& faces) {
  double volume = 0;
  for (const auto& [a, b, c] : faces) {
    volume +=
        glm::dot(glm::dvec3(positions[a]), glm::cross(glm::dvec3(positions[b]), glm::dvec3(positions[c]))) /
        6;
  }
  return volume;
}

inline size_t pieces_of(size_t vertices, const Faces& faces) {
  std::vector<uint32_t> root(vertices);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&](uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  size_t pieces = vertices;
  for (const auto& face : faces) {
    for (size_t i = 1; i < 3; ++i) {
      const uint32_t a = find(face[0]), b = find(face[i]);
      if (a != b) --pieces;
      root[a] = b;
    }
  }
  return pieces;
}

}  // namespace triptych
