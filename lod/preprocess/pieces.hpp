// Surfaces whose box is mostly air, such as pipes that cross in a hall, as pieces whose boxes fit.
#pragma once

#include "scene/surface.hpp"

#include <cstddef>
#include <vector>

namespace triptych {

/// A surface is never drawn in more pieces than this.
constexpr size_t most_pieces = 8;

/// The surface in pieces with a box each, if their boxes have at most four fifths of the area that the
/// whole's box has; nothing if it is better drawn as one. What is connected stays together. Connected
/// components are joined bottom-up, each time the two that raise expected_cost() the least, while it falls or
/// there are more than `most_pieces` (agglomerative clustering as in Walter, Bala, Kulkarni and Pingali, Fast
/// agglomerative clustering for rendering, 2008).
std::vector<Surface> fitting_pieces(const Surface& surface);

}  // namespace triptych
