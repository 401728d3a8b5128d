#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_hills(
    {.name = "geometry_hills",
     .group = "geometry",
     .breaks = "A landscape that is simplified seven times over: an error that forgets the levels below is "
               "too small at the top.",
     .faults = {"shrinking-bounds", "dropped-stretch"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 9; ++i)
         maker.mesh(awkward::grid(16, 4, 0.5), awkward::translation({4.0 * (i % 3), 4.0 * (i / 3), 0}));
       trial.model = maker.model();
       for (int i = 0; i < 10; ++i)
         trial.views.push_back(look({6, -2.0 - 6 * i * i, 3.0 + 2 * i}, {6, 6, 0}, 100, {320, 240}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
