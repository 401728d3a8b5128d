#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_equal_centroids(
    {.name = "geometry_equal_centroids",
     .group = "geometry",
     .breaks = "All triangles share one centroid: no plane divides them.",
     .faults = {},
     .make = [] {
       Trial trial;
       Mesh mesh{"star", {}, {}};
       Random random(19);
       for (uint32_t i = 0; i < 300; ++i) {
         const glm::dvec3 a = random.vector(-2, 2), b = random.vector(-2, 2);
         mesh.positions.insert(mesh.positions.end(), {a, b, -(a + b)});
         mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
       }
       trial.model = Maker().mesh(mesh).box({6, -1, -1}, {7, 1, 1}).model();
       trial.views = around({0, 0, 0}, 9, 6);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
