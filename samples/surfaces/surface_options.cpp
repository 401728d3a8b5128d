#include "samples/surfaces/surface_options.hpp"

#include "base/error.hpp"

namespace triptych {

void check_surface_options(const std::string& sample, const SurfaceOptions& options) {
  if (options.triangles < least_surface_triangles || options.triangles > most_surface_triangles)
    fail(sample, "{} triangles; {} to {} can be made", options.triangles, least_surface_triangles,
         most_surface_triangles);
}

}  // namespace triptych
