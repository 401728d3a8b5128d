// What the samples that are one streamed surface share.
#pragma once

#include <cstdint>
#include <string>

namespace triptych {

/// The fewest and the most triangles of a sample that is one surface.
inline constexpr uint64_t min_surface_triangles = 1'000, max_surface_triangles = 500'000'000;

struct SurfaceOptions {
  uint64_t triangles = 10'000'000;  ///< kept within a tenth
  uint64_t seed = 1;                ///< decides everything: equal options give equal files
};

/// Error (place: the sample) for a number of triangles out of range.
void check_surface_options(const std::string& sample, const SurfaceOptions& options);

}  // namespace triptych
