#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_coplanar_objects(
    {.name = "depth_coplanar_objects",
     .group = "depth",
     .breaks = "Faces of two objects in one plane: whoever is drawn first stays, in every pass and whatever "
               "was culled.",
     .faults = {"strict-depth-test+no-dilation"},
     .make = [] {
       Trial trial;
       trial.build.keep = {.planes = false, .cover = false};  // nothing but the rank of drawing decides
       trial.model = scenes::make("coplanar");
       trial.views = around({3, 3, 2}, 7, 8);
       trial.views.push_back(look({3, 3, 12}, {3, 3, 0}, 50, {}, 0.01, {0, 1, 0}));
       trial.views.push_back(look({-6, 3, 2}, {3, 3, 2}, 50));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
