#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_one_plane_from_afar(
    {.name = "depth_one_plane_from_afar",
     .group = "depth",
     .breaks = "A finish lies flush in a slab, among small things: seen from far away their points are "
               "brought together, and out of the plane.",
     .faults = {"untold-layers"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.box({-9, -9, -0.3}, {9, 9, 0});
       maker.box({-20, -20, -0.02}, {20, 20, 0});
       for (int i = 0; i < 150; ++i) {
         const glm::dvec3 lo(0.6 * (i * 7 % 31) - 9, 0.6 * (i * 11 % 29) - 8.5, 0.3 + 0.2 * (i % 23));
         maker.box(lo, lo + 0.12 + 0.01 * (i % 9));
       }
       trial.model = maker.model();
       // The slab alone is blue, and the finish covers all of it for views from above.
       trial.model.materials.resize(3);
       trial.model.materials[0].base_color = {0, 0, 1, 1};
       trial.model.materials[1].base_color = {1, 0, 0, 1};
       trial.model.materials[2].base_color = {1, 1, 0, 1};
       for (size_t i = 0; i < trial.model.meshes.size(); ++i) {
         for (Triangle& triangle : trial.model.meshes[i].triangles)
           triangle.material = static_cast<uint32_t>(std::min<size_t>(i, 2));
       }
       trial.no_blue = true;
       for (int i = 0; i < 8; ++i) {
         const double far = 25 * std::pow(1.4, i);
         trial.views.push_back(look({0.5 * far, 0.3 * far, 0.7 * far}, {0.1 * i, 0, 0}, 60));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
