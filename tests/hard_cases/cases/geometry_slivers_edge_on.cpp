#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_slivers_edge_on(
    {.name = "geometry_slivers_edge_on",
     .group = "geometry",
     .breaks = "A triangle seen edge-on has depth interpolated beyond its own vertices: from behind a wall "
               "it comes out in front of it, or of everything.",
     .faults = {"no-fragment-bound"},
     .make = [] {
       Trial trial;
       constexpr int side = 256;
       const glm::dvec3 eye(0.3, 0.2, 0);
       Random random(13);
       Maker maker;
       maker.quad({-20, -20, -3.9}, {40, 0, 0}, {0, 40, 0});
       for (int object = 0; object < 40; ++object) {
         Mesh mesh{"slivers", {}, {}};
         for (uint32_t i = 0; i < 300; ++i) {
           // Three points in nearly one line of the picture, at any depth.
           const glm::dvec2 middle(random.number(-0.9, 0.9), random.number(-0.9, 0.9));
           const double angle = random.number(0, 3.1416);
           const glm::dvec2 along(std::cos(angle), std::sin(angle)), aside(-along.y, along.x);
           for (int corner = 0; corner < 3; ++corner) {
             const glm::dvec2 at =
                 middle + along * random.number(-0.1, 0.1) + aside * (random.number(-1, 1) * 0x1p-9 / side);
             mesh.positions.push_back(eye + random.number(4, 8) * glm::dvec3(at, -1));
           }
           mesh.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
         }
         maker.mesh(std::move(mesh));
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = trial.build.part_triangles = 512;
       trial.pixel_error = 1e-6;
       trial.slivers = true;
       for (int i = 0; i < 4; ++i) {
         const glm::dvec3 beside = eye + glm::dvec3(1e-4 * i, 0, 0);
         trial.views.push_back(look(beside, beside - glm::dvec3(0, 0, 1), 90, {side, side}, 0.01, {0, 1, 0}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
