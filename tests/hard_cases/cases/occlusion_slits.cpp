#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_slits({.name = "occlusion_slits",
                                 .group = "occlusion",
                                 .breaks = "Slits of a pixel between boards, at every slant.",
                                 .faults = {"withheld-id"},
                                 .make = [] {
                                   Trial trial;
                                   Maker maker;
                                   for (int i = 0; i < 40; ++i)
                                     maker.box({0.5 * i, 0, 0}, {0.5 * i + 0.46, 0.1, 8});
                                   maker.clutter(120, {0, 2, 0}, {20, 12, 8}, 0.7, 15);
                                   trial.model = maker.model();
                                   trial.build.leaf_triangles = 12;
                                   for (int i = 0; i < 8; ++i)
                                     trial.views.push_back(look({3.0 * i, -6, 3}, {10, 3, 4}, 60, {160, 64}));
                                   return trial;
                                 }});

}  // namespace
}  // namespace triptych::hard_cases
