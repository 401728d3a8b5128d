#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_one_plane(
    {.name = "depth_one_plane",
     .group = "depth",
     .breaks =
         "A floor, its finish and paint lie in one plane: which of them shows flickers as the eye moves.",
     .faults = {"untold-layers"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.box({-7.5, -7.5, -0.3}, {7.5, 7.5, 0});
       for (int i = 0; i < 16; ++i) {
         Mesh tile = awkward::grid(static_cast<uint32_t>(1 + i % 5), 4);
         for (glm::dvec3& position : tile.positions)
           position += glm::dvec3(4 * (i % 4) - 8, 4 * (i / 4) - 8, 0);
         maker.mesh(std::move(tile));
       }
       trial.model = maker.model();
       // The slab alone is blue, and the finish covers all that the views see.
       trial.model.materials.resize(2);
       trial.model.materials[0].base_color = {0, 0, 1, 1};
       trial.model.materials[1].base_color = {1, 0, 0, 1};
       for (size_t i = 0; i < trial.model.meshes.size(); ++i) {
         for (Triangle& triangle : trial.model.meshes[i].triangles) triangle.material = i > 0;
       }
       trial.no_blue = true;
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({2.0 * std::cos(i), 2.0 * std::sin(i), 2.5}, {0.1 * i, 0, 0}, 60));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
