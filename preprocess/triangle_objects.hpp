// Which source object each triangle of a simplified surface comes from.
#pragma once

#include "preprocess/hlod.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Of the geometry that an HLOD begins with. Simplification merges points, so that a triangle's corners say
/// what it comes from: the object that most of its corners belong to, among these the one with most area
/// around them.
class TriangleObjects {
 public:
  /// Without Baked::objects everything below is empty.
  explicit TriangleObjects(const Baked& geometry);

  /// For each triangle of a level of the geometry.
  std::vector<SourceObjectId> of(const Piece& level) const;
  /// For each triangle of a level's chunk, in the chunk's order, as it is stored.
  std::vector<std::byte> encoded(const Piece& level, const EncodedChunk& chunk) const;

 private:
  /// An object with its area around a point, square lattice steps.
  struct Share {
    SourceObjectId object = no_id;
    double area = 0;
  };
  std::span<const Share> shares_at(uint32_t point) const;
  SourceObjectId of(const std::array<uint32_t, 3>& corners) const;

  std::vector<uint32_t> first_shares_;  ///< for each point of the geometry, and the end
  std::vector<Share> shares_;
};

/// As run lengths; scene/stored_objects.hpp reads them back.
std::vector<std::byte> encode_triangle_objects(std::span<const SourceObjectId> objects);

}  // namespace triptych
