#include "samples/surfaces/surface_options.hpp"

#include "base/error.hpp"

namespace triptych {

void check_surface_options(const std::string& sample, const SurfaceOptions& options) {
  if (options.triangles < min_surface_triangles || options.triangles > max_surface_triangles)
    fail(sample, "{} triangles; {} to {} can be made", options.triangles, min_surface_triangles,
         max_surface_triangles);
}

}  // namespace triptych
