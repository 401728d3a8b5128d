#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery touching_slabs(
    {.name = "touching_slabs",
     .group = "touching",
     .breaks = "A floor of slabs side by side, seen from above and from far away: white lines between them.",
     .faults = {"loose-contacts"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::box({0, 0, -0.25}, {3, 3, 0}));
       for (int i = 1; i < 144; ++i) maker.place(awkward::translation({3.0 * (i % 12), 3.0 * (i / 12), 0}));
       trial.model = maker.model();
       trial.build.leaf_triangles = 24;
       trial.closed = true;
       for (int i = 0; i < 5; ++i)
         trial.views.push_back(look_parallel({18 + 4.0 * i, 10, 60}, {18, 18, 0}, 20 + 12 * i, {160, 120}));
       for (int i = 0; i < 3; ++i)
         trial.views.push_back(look({18, -20.0 - 40 * i, 14.0 + 30 * i}, {18, 18, 0}, 50, {160, 120}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
