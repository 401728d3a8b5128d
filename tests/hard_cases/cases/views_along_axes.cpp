#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_along_axes(
    {.name = "views_along_axes",
     .group = "views",
     .breaks = "Exactly along an axis the zeros in the rotation meet the zeros in the boxes.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.thin = true;
       trial.model = snapped(Maker().clutter(80, {-4, -4, -4}, {4, 4, 4}, 1.5, 11).model(), 0.125);
       for (int axis = 0; axis < 3; ++axis) {
         glm::dvec3 along(0), up(0);
         along[axis] = 1;
         up[(axis + 1) % 3] = 1;
         for (const double side : {-9.0, 9.0, 0.0}) {
           trial.views.push_back(look(along * side, along * (side > 0 ? -1.0 : 20.0), 60, {}, 0.01, up));
           trial.views.push_back(look(along * side, along * (side > 0 ? -1.0 : 20.0), 90, {}, 0.01, -up));
         }
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
