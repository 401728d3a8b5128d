#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_fence_and_foliage(
    {.name = "occlusion_fence_and_foliage",
     .group = "occlusion",
     .breaks = "Foliage hides much and closes nothing.",
     .faults = {"stale-camera"},
     .make = [] {
       Trial trial;
       Maker maker;
       Random random(16);
       for (int tree = 0; tree < 6; ++tree) {
         Mesh leaves = awkward::soup(120, static_cast<uint32_t>(tree + 1));
         maker.mesh(leaves, linear({0.3, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, {4.0 * tree - 10, 0.5 * tree, 0}));
       }
       maker.clutter(60, {-10, 5, 0}, {12, 12, 4}, 1, 17);
       trial.model = maker.model();
       for (int i = 0; i < 8; ++i) trial.views.push_back(look({2.5 * i - 10, -4, 1.5}, {0, 6, 1.5}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
