#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_objects_at_one_place(
    {.name = "geometry_objects_at_one_place",
     .group = "geometry",
     .breaks = "A hundred thousand objects at one place are each other's neighbours: where all have the same "
               "few for neighbours, nothing else finds together.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0.5});
       for (int i = 1; i < 100'000; ++i) maker.place(Affine(1));
       maker.box({0, 0, -1}, {1, 1, -0.5});
       trial.model = maker.model();
       trial.build = {};
       trial.max_drawables = 100;
       trial.views = around({1, 1, 0}, 4, 3);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
