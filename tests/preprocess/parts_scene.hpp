// A scene of parts as the build has them after the first partition, for tests of what compares placed parts.
#pragma once

#include "preprocess/parts.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych::test {

constexpr double step = 0x1p-10;  ///< of its lattice

/// Placed meshes as parts of one hierarchy, each an instance.
struct PartsScene {
  PartsScene()
      : file(std::filesystem::path(testing::TempDir()) / ("triptych_parts_" + std::to_string(::getpid()))) {
    parts.lattices = {Lattice{{0, 0, 0}, step}};
    parts.hierarchies.emplace_back();
    hierarchy().transforms = {Affine(1)};
    hierarchy().stretches = {1};
  }
  ~PartsScene() { std::filesystem::remove(file.path()); }

  uint32_t add_part(const Mesh& mesh) {
    const Part part{awkward::surface_of(mesh), {}};
    PartInfo info;
    info.triangles = static_cast<uint32_t>(part.surface.triangles.size());
    info.place = file.append(record_bytes(part));
    const auto& triangles = part.surface.triangles;
    const bool is_plain = std::ranges::all_of(
        triangles, [&](const Triangle& triangle) { return triangle.material == triangles[0].material; });
    if (is_plain) info.color = triangles[0].material;
    boxes.push_back(part.surface.box());
    parts.parts.push_back(info);
    return static_cast<uint32_t>(parts.parts.size() - 1);
  }
  /// Moved by so much, model units.
  uint32_t place(uint32_t part, const glm::dvec3& by = glm::dvec3(0)) {
    const auto number = static_cast<uint32_t>(hierarchy().placed.size());
    hierarchy().transforms.push_back(awkward::translation(by));
    hierarchy().stretches.push_back(1);
    hierarchy().placed.push_back({part, number + 1, number});
    LatticeBox box = boxes[part];
    box.lo += glm::ivec3(by / step) - 1;
    box.hi += glm::ivec3(by / step) + 1;
    hierarchy().boxes.push_back(box);
    return number;
  }
  uint32_t add(const Mesh& mesh) { return place(add_part(mesh)); }

  PlacedParts& hierarchy() { return parts.hierarchies[0]; }
  Parts parts;
  SpoolFile file;
  std::vector<LatticeBox> boxes;
};

}  // namespace triptych::test
