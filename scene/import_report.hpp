// What happened to a model on its way into a pack.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// What an import or a build dropped, merged or could not do. Nothing is dropped without being counted here.
struct ImportReport {
  uint64_t dropped_triangles = 0;  ///< non-finite, or of no area after welding
  uint64_t welded_vertices = 0;
  /// Faces that half-edges cannot represent (non-manifold), which took the other route.
  uint64_t repaired_edges = 0;
  uint64_t stuck_groups = 0;  ///< drawables that no simplifier made coarser
  std::vector<std::string> warnings;
};

}  // namespace triptych
