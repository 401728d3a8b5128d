// Which source object each triangle of a simplified surface comes from.
#pragma once

#include "preprocess/hlod.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <tsl/robin_map.h>
#include <vector>

namespace triptych {

/// Of the geometry that an HLOD begins with. Simplification keeps points where they are and merges them, so
/// that a triangle's corners say what it comes from: the object that most of its corners belong to, among
/// these the one with most area around them.
class TriangleObjects {
 public:
  /// Without Baked::objects everything below is empty.
  explicit TriangleObjects(const Baked& geometry);

  /// For each triangle of a level of the geometry.
  std::vector<SourceObjectId> of(const Surface& level) const;
  /// For each triangle of a chunk of a level, in the chunk's order, as it is stored.
  std::vector<std::byte> encoded(const EncodedChunk& level) const;

 private:
  /// An object with its area around a point, square lattice steps.
  struct Share {
    SourceObjectId object = no_id;
    double area = 0;
  };
  std::span<const Share> shares_at(const glm::ivec3& point) const;
  SourceObjectId of(const std::array<glm::ivec3, 3>& corners) const;

  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> points_;  ///< to first_shares_
  std::vector<uint32_t> first_shares_;                    ///< for each point, and the end
  std::vector<Share> shares_;
};

/// As run lengths; scene/stored_objects.hpp reads them back.
std::vector<std::byte> encode_triangle_objects(std::span<const SourceObjectId> objects);

}  // namespace triptych
