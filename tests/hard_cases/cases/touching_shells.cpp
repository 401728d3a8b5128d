#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery touching_shells(
    {.name = "touching_shells",
     .group = "touching",
     .breaks = "Balls just beneath shells: each may be off by its own bound, and what is hidden comes out.",
     .faults = {"no-room", "unmarked-levels"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 4; ++i) {
         const glm::dvec3 at(3.0 * i, 0, 0);
         maker.mesh(awkward::sphere(20, 1, at)).mesh(awkward::sphere(17, 0.988, at));
       }
       trial.model = maker.model();
       trial.model.materials.resize(2);
       trial.model.materials[0].base_color = {1, 1, 0, 1};
       trial.model.materials[1].base_color = {0, 0, 1, 1};
       for (size_t i = 0; i < trial.model.meshes.size(); ++i) {
         for (Triangle& triangle : trial.model.meshes[i].triangles) triangle.material = i % 2;
       }
       trial.no_blue = true;
       for (int i = 0; i < 8; ++i) trial.views.push_back(look({4.5 + i, -4.0 - 3 * i, 2}, {4.5, 0, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
