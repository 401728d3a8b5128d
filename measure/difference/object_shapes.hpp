// What the source objects of a pack look like at full detail, in the model's space.
#pragma once

#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace triptych {

/// Triangles in the model's space with the colours of their corners, which are the same where a material has
/// one. In no order that means anything.
struct PlacedShape {
  struct Facet {
    std::array<glm::dvec3, 3> corners;
    CornerColors colors;
  };
  std::vector<Facet> facets;
  Box box;
  /// How far a corner may lie from where the model's file has it, model units: what rounding to the lattice
  /// and the enlarging of triangles that would have vanished can have moved it by.
  double tolerance = 0;
};

/// The finest drawables of all leaves, sorted by the source object that they show.
class ObjectShapes {
 public:
  /// Both must outlive it.
  ObjectShapes(const Pack& pack, const PackObjects& objects);

  /// How many source objects the pack has; with this as its id, what belongs to none is an object too.
  SourceObjectId nameless() const { return static_cast<SourceObjectId>(firsts_.size() - 2); }
  std::span<const Placement> placements_of(SourceObjectId object) const;
  uint64_t triangles_of(SourceObjectId object) const;
  /// A box that holds the object; empty where it has no triangles.
  Box box_of(SourceObjectId object) const;
  /// The same for objects that were built of the same chunks in the same places and colours, also in
  /// different packs and whatever the order.
  uint64_t signature_of(SourceObjectId object) const;
  /// Reads the object's chunks. Error (pack, chunk) for damage. Safe on several threads.
  PlacedShape shape_of(SourceObjectId object) const;

  const Pack& pack() const { return pack_; }

 private:
  const Pack& pack_;
  std::vector<uint64_t> firsts_;  ///< for each object, for none, and the end: index into placements_
  std::vector<Placement> placements_;
  uint64_t palette_hash_ = 0;
};

}  // namespace triptych
