// Meshes with colours of vertices.
#pragma once

#include "tests/support/awkward_meshes.hpp"

#include <cmath>

namespace triptych::test {

/// Hills whose colours follow the place, smoothly.
inline Mesh painted_hills() {
  Mesh mesh = awkward::grid(24, 20, 2);
  for (const glm::dvec3& position : mesh.positions) {
    const auto channel = [](double value) { return static_cast<uint8_t>(127.5 + 127.5 * std::sin(value)); };
    mesh.colors.push_back(
        {channel(0.9 * position.x), channel(0.7 * position.y + 1), channel(position.z), 255});
  }
  return mesh;
}

/// A box whose sides have a colour each: seams run along its edges.
inline Mesh painted_box(const glm::dvec3& lo, const glm::dvec3& hi) {
  const Mesh box = awkward::box(lo, hi);
  Mesh mesh{"painted box", {}, {}};
  for (size_t t = 0; t < box.triangles.size(); ++t) {
    const auto side = static_cast<uint8_t>(t / 2 * 40);
    Triangle& triangle = mesh.triangles.emplace_back();
    for (size_t k = 0; k < 3; ++k) {
      triangle.vertices[k] = static_cast<uint32_t>(mesh.positions.size());
      mesh.positions.push_back(box.positions[box.triangles[t].vertices[k]]);
      mesh.colors.push_back({static_cast<uint8_t>(240 - side), side, 90, 255});
    }
  }
  return mesh;
}

}  // namespace triptych::test
