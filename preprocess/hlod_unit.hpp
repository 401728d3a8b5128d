// The unit UnitKind::hlod: the levels of an inner scene node, made of its children's coarsest geometry.
#pragma once

#include "preprocess/build.hpp"
#include "preprocess/build_unit.hpp"
#include "preprocess/hlod.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// A part of what an inner node begins with: the coarsest geometry of a child, or of a part of it.
struct HlodSource {
  Surface surface;
  std::vector<LeafSpan> spans;          ///< for each point
  std::vector<SourceObjectId> objects;  ///< for each triangle; empty where the model has none
  const Lattice* lattice = nullptr;     ///< null: it is on that of the hierarchy
  Affine transform{1};                  ///< from there to the hierarchy's space
  bool seen_from_outside = false;       ///< something that others cover was left out
};

/// What is known of an inner node's drawables, beside their chunks.
struct HlodFigures {
  std::vector<double> errors;  ///< of each drawable
  double coarsest_error = 0;   ///< of the geometry that its parent begins with
  bool stuck = false;
  std::vector<std::vector<std::byte>> objects;  ///< NodeContent::triangle_objects
};
template <>
inline constexpr auto record_members<HlodFigures> = std::tuple(&HlodFigures::errors,
                                                               &HlodFigures::coarsest_error,
                                                               &HlodFigures::stuck, &HlodFigures::objects);

/// What the HLODs of a hierarchy have in common.
struct HlodPlace {
  const BuildOptions& options;
  const Lattice& lattice;
  Palette palette;              ///< Parts::palette_view()
  uint32_t lattice_number = 0;  ///< index into Parts::lattices
  bool has_objects = false;     ///< Parts::has_objects
};

/// The sources as one surface. error: the largest bound of one.
Baked bake(std::span<const HlodSource> sources, double error, const HlodPlace& where);

/// sources: the geometry of a node whose leaves have the places first_place up to, not including, end_place.
/// gaps: errors that its levels may not have. Levels that draw little less than the children, and more than
/// BuildOptions::hlod_triangles, are left out, if need be all of them. The result has the chunks, a record of
/// the Baked that the parent begins with, and HlodFigures. It is made in the subtree's own numbers
/// (preprocess/relocation.hpp), and taken from BuildOptions::cache where that has it.
UnitResult hlod_unit(std::vector<HlodSource> sources, double error, uint32_t first_place, uint32_t end_place,
                     const std::vector<ErrorGap>& gaps, const HlodPlace& where);

}  // namespace triptych
