// Faces in which two closed bodies lie against each other: nobody outside of both sees them.
#pragma once

#include "simplify/surface.hpp"

#include <cstdint>
#include <vector>

namespace triptych {

/// For each inner triangle how far any of its patch is from what stays, lattice steps; negative for the
/// others. Inner ones lie on others that turn their backs to them, corner on corner (two of a quadrangle
/// may be divided by its other diagonal), and around each of their patches both bodies go on backwards from
/// the patch. Only of bodies each of whose edges is passed as often one way as the other: so what is left of
/// two bodies is closed again, and inner faces lie within it.
std::vector<double> find_inner_faces(const Surface& surface);

/// Those that are no further than `most` lattice steps become covered ones of their distance's class. moved:
/// how far the surface was moved just before, which counts besides.
void mark_inner_faces(Surface& surface, double most, double moved = 0);

}  // namespace triptych
