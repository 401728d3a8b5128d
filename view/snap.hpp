// What the cursor means when something is measured: the nearest corner, else edge, else the surface, at full
// detail.
#pragma once

#include "view/near_cursor.hpp"

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace triptych {

enum class SnapKind { vertex, edge, face };

struct Snap {
  SnapKind kind = SnapKind::face;
  glm::dvec3 point{0};          ///< model space
  glm::dvec3 from{0}, to{0};    ///< the edge's ends; of no meaning for others
  glm::dvec3 normal{0};         ///< the face's, of length 1; of no meaning for others
  DrawableId drawable = no_id;  ///< a leaf's finest one
};

/// How far snaps reach, pixels.
inline constexpr double snap_pixels = 10;

/// A corner is where edges end or turn; an edge is where a surface ends, or turns by more than a degree:
/// where triangles of one plane meet, there is none. Only what is seen from the eye counts. Nullopt where
/// there is background, and no edge near.
std::optional<Snap> snap(const NearCursor& near);

/// An edge that a person sees, and the planes beside it.
struct FeatureEdge {
  glm::dvec3 from{0}, to{0};
  glm::dvec3 normals[2] = {};  ///< of its two faces, length 1; the second is 0 where the surface ends
  double turn = 0;             ///< the sine of the angle between them; 1 where the surface ends
  DrawableId drawable = no_id;
};

/// Corners that are nearer than `weld` to each other, model units, are one. Edges by which the surface turns
/// by less than the sine `least_turn` are left out.
std::vector<FeatureEdge> feature_edges(const std::vector<NearFacet>& facets, double weld, double least_turn);

}  // namespace triptych
