// From a pack to its cells and portals.
#pragma once

#include "cells/cell_graph.hpp"
#include "cells/walls.hpp"

namespace triptych {

/// Finds what the walls leave open between the cells of a graph that split_space() made of them.
void add_portals(const Walls& walls, CellGraph& graph);

/// Divides space along the walls and finds what they leave open. A function of its arguments alone.
CellGraph make_cells(const Walls& walls, const Box& model);

/// The same of a pack's full detail, which is read for it. One cell without portals where it has no walls.
/// Error as Pack::read_chunk().
CellGraph make_cells(const Pack& pack);

}  // namespace triptych
