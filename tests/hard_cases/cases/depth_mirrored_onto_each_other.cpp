#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_mirrored_onto_each_other(
    {.name = "depth_mirrored_onto_each_other",
     .group = "depth",
     .breaks = "Two walls of tiles, each the mirror image of the other in its own plane: every fragment has "
               "a rival of another colour at the same depth, computed under another matrix.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       Mesh tiles{"tiles", {}, {}};
       Random random(5);
       for (uint32_t i = 0; i < 200; ++i) {
         const glm::dvec3 at = random.vector() * glm::dvec3(7, 0, 5);
         tiles.positions.insert(tiles.positions.end(),
                                {at, at + glm::dvec3(0.8, 0, 0.1), at + glm::dvec3(0.2, 0, 0.9)});
         tiles.triangles.push_back({{3 * i, 3 * i + 1, 3 * i + 2}, 0});
       }
       const Affine mirror = linear({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {8, 0, 0});
       for (int i = 0; i < 2; ++i) {
         maker.mesh(tiles).place(mirror);
         maker.place(linear({-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {8, 0, 0}));
       }
       maker.clutter(40, {0, 1, 0}, {8, 4, 5}, 1);
       trial.model = maker.model();
       trial.slivers = true;
       for (int i = 0; i < 6; ++i) trial.views.push_back(look({1.3 * i, -6, 2}, {4, 0, 2.5}));
       trial.views.push_back(look({4, -6, 2.5}, {4, 0, 2.5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
