// Vertex colours that are those of whole triangles, as programs write them that have colours of faces: such
// meshes are drawn and simplified as if each colour were a material's. Where a material has a texture or
// light of its own, vertices keep their colours.
#pragma once

#include "preprocess/vertex_tint.hpp"
#include "scene/surface_material.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>

namespace triptych {

/// A mesh whose triangles have more colours than this keeps those of its vertices: what has so many is
/// graded.
inline constexpr size_t max_flat_colors = 64;

/// Looks at the triangles of one mesh.
class FlatColorSearch {
 public:
  explicit FlatColorSearch(const VertexTint& tint) : tint_(tint) {}

  void add(const CornerColors& corners, uint32_t material);
  /// The colours of its triangles as they are drawn, if each has one at all its corners and they are no more
  /// than max_flat_colors; nothing otherwise.
  const std::optional<std::set<DisplayColor>>& colors() const { return colors_; }

 private:
  const VertexTint& tint_;
  std::optional<std::set<DisplayColor>> colors_ = std::set<DisplayColor>();
};

/// The palette indices of a model's.
using FlatColors = std::map<DisplayColor, uint32_t>;

/// Where the colours of a mesh's triangles come from.
struct MeshColors {
  std::span<const uint32_t> materials;             ///< palette indices
  const VertexTint* tint = nullptr;                ///< if vertices have colours
  const FlatColors* flat = nullptr;                ///< if these are flat
  std::span<const SurfaceMaterial> surfaces = {};  ///< of the palette (Skeleton::materials)

  /// Whether corners keep colours of their own.
  bool of_corners() const { return tint != nullptr && flat == nullptr; }
};

}  // namespace triptych
