// The sample `isosurface`: the boundary between two gases that mix, in the manner of the Richtmyer-Meshkov
// simulations of Mirin et al. (1999): bubbles and spikes, holes, loose drops.
#pragma once

#include "samples/surfaces/polygoniser.hpp"
#include "samples/surfaces/surface_options.hpp"

namespace triptych {

/// The density field: negative in the heavy gas, below. Octaves end where the step could not show them.
std::unique_ptr<Field> mixing_layer(uint64_t seed, double step);

/// Writes `scene.ply`, `walk.json`, `fly.json`, `spin.json` and `jump.json`. The surface is closed but where
/// it meets the four sides of the domain. Error for a number of triangles out of range.
SurfaceReport make_isosurface(const SurfaceOptions& options, const std::filesystem::path& folder);

}  // namespace triptych
