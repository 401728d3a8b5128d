// The k-D tree: space divided along the planes that most of a wall lies in.
#pragma once

#include "cells/cell_graph.hpp"
#include "cells/walls.hpp"

namespace triptych {

/// tree, cells (without portals) and box of a graph. The box is `model`, grown a little. Each inner node's
/// plane is the one whose walls cover the largest share of the node's cross-section, of those that cover at
/// least a tenth of it.
CellGraph split_space(const Walls& walls, const Box& model);

/// The walls in the plane of an inner node, or null: they are within tolerance of it.
const WallPlane* walls_at(const Walls& walls, int axis, double at);

}  // namespace triptych
