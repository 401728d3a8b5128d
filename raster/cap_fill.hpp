// Cut surfaces of solids: where a ray comes into what a section keeps, within something solid.
#pragma once

#include "raster/geometry_stage.hpp"

namespace triptych {

/// A ray's winding number where it comes in is what lies behind it: of the triangles of a closed surface the
/// backs that it passes from there on, less the fronts. Where that is above 0 for the outward triangles
/// (Chunk::outward) of a stretch, its cap is drawn: as deep as the ray comes in, and with the slot of the
/// nearest back behind it. Caps are held to the limit of that back's piece as all that is drawn of it, and
/// lie where that is drawn: so bounds of boxes hold for them, and no culling changes one.
///
/// range: numbered, a whole stretch that a section may cut. triangles: all of it that covers pixels, whatever
/// is drawn before them; cleared of what is not outward. Rows first to last, both included.
void fill_caps(const GeometryTerms& terms, const DrawnRange& range, const StretchTriangles& triangles,
               int32_t first, int32_t last, const FillTarget& target);

/// Whether a stretch may have caps.
inline bool may_have_caps(const RasterChunk& chunk, uint32_t cut) { return cut != 0 && chunk.has_outward; }

}  // namespace triptych
