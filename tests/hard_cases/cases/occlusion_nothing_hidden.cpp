#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_nothing_hidden(
    {.name = "occlusion_nothing_hidden",
     .group = "occlusion",
     .breaks = "A plain of tiles seen from above: all of it shows, every test is in vain and every answer "
               "must be yes.",
     .faults = {"withheld-id"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 144; ++i) maker.quad({i % 12 - 6.0, i / 12 - 6.0, 0}, {0.9, 0, 0}, {0, 0.9, 0});
       trial.model = maker.model();
       trial.build.leaf_triangles = 2;
       trial.pixel_error = 0.1;
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({0.3 * i, 0, 11}, {0, 0, 0}, 65, {}, 0.01, {0, 1, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
