// The sample `statue`: a robed figure with a torch on a plinth, one closed surface with finely folded drapery
// and hair.
#pragma once

#include "samples/surfaces/polygoniser.hpp"
#include "samples/surfaces/surface_options.hpp"

namespace triptych {

/// Distances to the figure in metres, negative inside; details end where the step could not show them. The
/// figure stands on y = 0 and looks along +z.
std::unique_ptr<Field> statue_field(uint64_t seed, double step);

/// Writes `scene.ply`, `walk.json`, `fly.json`, `spin.json` and `jump.json`. Error for a number of triangles
/// out of range.
SurfaceReport make_statue(const SurfaceOptions& options, const std::filesystem::path& folder);

}  // namespace triptych
