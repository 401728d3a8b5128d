#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_layers_before_a_core(
    {.name = "depth_layers_before_a_core",
     .group = "depth",
     .breaks =
         "Slabs end in the planes of thin facades, and lines on slabs: moved behind them by what snapping "
         "may do, a facade lets its core through.",
     .faults = {"wide-layers"},
     .make = [] {
       Trial trial;
       Maker maker;
       const glm::dvec3 thickness(0.1, 0.004, 0.1);
       for (int i = 0; i < 5; ++i) {
         const double x = 3 * i - 7.5;
         const glm::dvec3 lo(x, 0, 0), hi(x + 3, 2, 4);
         maker.box(lo, hi).box(lo + thickness, hi - thickness);
         maker.box({x, 0, 3.999}, {x + 3, 2, 4.3}).box({x, 0, 4.1}, {x + 3, 2, 4.13});
       }
       trial.model = maker.model();
       // The cores alone are blue.
       trial.model.materials.resize(4);
       trial.model.materials[0].base_color = {1, 1, 0, 1};
       trial.model.materials[1].base_color = {0, 0, 1, 1};
       trial.model.materials[2].base_color = {1, 0, 0, 1};
       trial.model.materials[3].base_color = {1, 0.5, 0, 1};
       for (size_t i = 0; i < trial.model.meshes.size(); ++i) {
         for (Triangle& triangle : trial.model.meshes[i].triangles)
           triangle.material = static_cast<uint32_t>(i % 4);
       }
       trial.no_blue = true;
       for (int i = 0; i < 8; ++i) {
         const double angle = 0.35 * i - 1.2, far = 33 + i;
         const glm::dvec3 eye(far * std::sin(angle), 1 - far * std::cos(angle), 2 + i), target(0, 1, 2);
         trial.views.push_back(i % 4 == 3 ? look_parallel(eye, target, far) : look(eye, target, 60));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
