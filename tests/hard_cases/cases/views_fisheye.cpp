#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_fisheye(
    {.name = "views_fisheye",
     .group = "views",
     .breaks = "At 175 degrees the edge of the picture is seen at a slant of 1 to 23: deviations there are "
               "23 times as long.",
     .faults = {"dropped-stretch"},
     .make = [] {
       Trial trial;
       Maker maker;
       Random random(7);
       for (int i = 0; i < 14; ++i)
         maker.mesh(awkward::sphere(14, 1), awkward::translation(random.vector(-9, 9)));
       trial.model = maker.model();
       trial.pixel_error = 0.5;
       for (int i = 0; i < 10; ++i) {
         const glm::dvec3 eye = random.vector(-8, 8);
         trial.views.push_back(look(eye, eye + random.vector(-1, 1), 175, {256, 256}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
