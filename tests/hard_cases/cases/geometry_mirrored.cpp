#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_mirrored(
    {.name = "geometry_mirrored",
     .group = "geometry",
     .breaks = "Mirrored placements turn their triangles over; levels of detail that join them with others "
               "must turn them back.",
     .faults = {"unflipped-mirror"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::sphere(8, 0.9), linear({-1, 0, 0}, {0, 1, 0}, {0, 0, 1}));
       for (int i = 1; i < 12; ++i)
         maker.place(linear({i % 4 ? -1 : 1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2.0 * (i % 4), 2.0 * (i / 4), 0}));
       trial.model = maker.model();
       trial.oriented = true;
       trial.build.hlod_triangles = 700;
       trial.pixel_error = 3;
       trial.views = around({3, 2, 0}, 12, 6);
       trial.views.push_back(look({60, 2, 20}, {3, 2, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
