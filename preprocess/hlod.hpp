// Hierarchical LODs: the geometry of a whole subtree, simplified, bottom-up (Erikson, Manocha and Baxter,
// HLODs for faster display of large static and dynamic environments, 2001).
#pragma once

#include "preprocess/build_rules.hpp"
#include "preprocess/covered/error_gaps.hpp"
#include "preprocess/leaf_span.hpp"
#include "preprocess/part.hpp"
#include "preprocess/pieces.hpp"
#include "scene/lattice.hpp"
#include "scene/source_objects.hpp"
#include "simplify/key_hash.hpp"
#include "simplify/simplify.hpp"
#include "simplify/surface.hpp"

#include <cstdint>
#include <span>
#include <tsl/robin_map.h>
#include <tsl/robin_set.h>
#include <vector>

namespace triptych {

/// Geometry of a subtree on the model's lattice.
struct Baked {
  Surface surface;
  std::vector<LeafSpan> spans;  ///< for each point
  double error = 0;             ///< proven bound of the two-sided distance to the source, model units
  /// For each triangle its source object, counted as the hierarchy does; empty where the model has none.
  std::vector<SourceObjectId> objects = {};
  bool seen_from_outside = false;  ///< something that others cover was left out
};

template <>
inline constexpr auto record_members<Baked> = std::tuple(&Baked::surface, &Baked::spans, &Baked::error,
                                                         &Baked::objects, &Baked::seen_from_outside);

/// Collects surfaces into one: equal points and equal triangles are merged.
class Baker {
 public:
  /// palette: of the surfaces' materials; what has no colours of corners gets those, beside surfaces that do.
  Baker(const Lattice& lattice, std::span<const VertexColor> palette, const BuildRules& rules)
      : lattice_(lattice), palette_(palette), rules_(rules) {}
  /// Adds geometry that is on the model's lattice already. `objects`: of each triangle the source object, or
  /// empty for a model that has none.
  void add(const Surface& surface, std::span<const LeafSpan> spans,
           std::span<const SourceObjectId> objects = {});
  /// Adds geometry on the lattice of its mesh, under a transform: each position is rounded to the model's
  /// lattice. Where that leaves a triangle without area, its corners move by one more step, so that no
  /// triangle is lost.
  void add(const Surface& surface, const Lattice& from, const Affine& transform,
           std::span<const LeafSpan> spans, std::span<const SourceObjectId> objects = {});
  /// What was collected. `error`: the bound of what was added; the result's bound also has how far it was
  /// moved.
  Baked finish(double error);

 private:
  uint32_t place(const glm::ivec3& point, const LeafSpan& span);
  void add_triangle(const Triangle& triangle, const SurfaceCorners* colors, const CornerNormals& normals,
                    std::span<const SourceObjectId> objects, size_t index);
  void fill_colors();

  const Lattice& lattice_;
  std::span<const VertexColor> palette_;
  const BuildRules& rules_;
  Baked baked_;
  tsl::robin_map<glm::ivec3, uint32_t, KeyHash> points_;
  tsl::robin_set<std::array<uint32_t, 3>, KeyHash, KeyEqual> triangles_;
  double moved_ = 0;  ///< lattice steps
};

struct HlodDrawable {
  Piece piece;  ///< sources: indices into the points of the children's geometry
  double error = 0;
  bool seen_from_outside = false;  ///< something that others cover was left out
};

struct Hlod {
  std::vector<HlodDrawable> drawables;  ///< finest first
  Baked coarsest;
  bool stuck = false;  ///< the simplifier could not reduce the children's triangles to as few as wanted
};

struct HlodLimits {
  uint32_t triangles = 32;  ///< of the coarsest level, roughly
  SimplifyLimits simplify;  ///< simplifier and kind of bound
  /// Errors that levels may not have. From their ends on what is covered is left out.
  std::vector<ErrorGap> gaps = {};
  bool begins_as_it_is = false;  ///< the children's geometry is the finest level
  bool shade = false;            ///< levels have the shading normals of the children's geometry
};

/// Levels for an inner scene node, whose leaves have the places first_place up to, not including, end_place.
/// Points on borders to other subtrees stay, so that surfaces that continue there stay closed at any mix of
/// levels.
Hlod make_hlod(Baked children, uint32_t first_place, uint32_t end_place, const Lattice& lattice,
               const HlodLimits& limits);

}  // namespace triptych
