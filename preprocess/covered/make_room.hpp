// Levels of detail keep what is covered beneath what covers it: up to some error there is room between them,
// and beyond it what nobody sees is left out.
#pragma once

#include "preprocess/covered/covered_report.hpp"
#include "preprocess/parts.hpp"
#include "preprocess/placed_cache.hpp"

namespace triptych {

/// Finds what is covered in all hierarchies, and tells the parts: which of their triangles, and which errors
/// their levels may not have, as those of what covers them. `memory`: bytes that geometry may take at a time,
/// roughly. kept: what earlier builds found.
CoveredReport make_room(Parts& parts, const SpoolFile& geometry, uint64_t memory, const PlacedCache& kept);

}  // namespace triptych
