#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_flattened(
    {.name = "geometry_flattened",
     .group = "geometry",
     .breaks = "Singular transforms press a mesh flat, which is still there to be seen.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::sphere(10, 1));
       maker.place(linear({2, 0, 0}, {0, 2, 0}, {0, 0, 0}, {4, 0, 0}));
       maker.place(linear({0, 0, 0}, {0, 2, 0}, {0, 0, 2}, {8, 0, 0}));
       maker.place(linear({1, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 4, 0}));
       maker.place(linear({1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {4, 4, 0}));
       trial.model = maker.model();
       trial.views = around({4, 2, 0}, 9, 8);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
