#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_behind_glass(
    {.name = "occlusion_behind_glass",
     .group = "occlusion",
     .breaks = "Panes of glass stand before everything, some of them flush with a wall, and some within each "
               "other: "
               "they hide nothing, and what is opaque hides them.",
     .faults = {"opaque-glass"},
     .make = [] {
       Maker maker;
       maker.clutter(60, {2, -5, 0}, {12, 5, 5}, 0.8);
       maker.box({7, -6, -1}, {7.25, 0, 6});
       const size_t opaque = 61;
       maker.box({1, -6, -1}, {1.02, 6, 6});
       maker.box({6.98, -6, -1}, {7, 0, 6});  // flush
       maker.box({4, -2, 0}, {6, 2, 3}).box({4.5, -1, 0.5}, {5.5, 1, 2.5});
       maker.mesh(awkward::sphere(16, 1.2, {9, 3, 2}));
       Trial trial;
       trial.model = maker.model();
       for (size_t i = opaque; i < trial.model.meshes.size(); ++i) {
         auto& triangles = trial.model.meshes[i].triangles;
         Material glass = trial.model.materials[triangles.front().material];
         glass.base_color.a = 0.3f + 0.1f * static_cast<float>(i - opaque);
         for (Triangle& triangle : triangles)
           triangle.material = static_cast<uint32_t>(trial.model.materials.size());
         trial.model.materials.push_back(glass);
       }
       for (int i = 0; i < 16; ++i)
         trial.views.push_back(look({-5 + 0.6 * i, 1.5 - 0.2 * i, 2 + 0.1 * i}, {6, 0, 2}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
