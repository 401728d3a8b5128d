#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_around_the_eye(
    {.name = "boxes_around_the_eye",
     .group = "boxes",
     .breaks = "The eye inside boxes, on their faces, edges and corners, to the last bit.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = Maker()
                         .box({0, 0, 0}, {4, 4, 4})
                         .box({4, 0, 0}, {8, 4, 4})
                         .box({1, 1, 1}, {3, 3, 3})
                         .clutter(30, {-8, -8, -8}, {8, 8, 8}, 2, 4)
                         .model();
       trial.build.leaf_triangles = 12;
       for (const glm::dvec3& eye : {glm::dvec3(2, 2, 2),
                                     {4, 2, 2},
                                     {4, 4, 2},
                                     {4, 4, 4},
                                     {0, 0, 0},
                                     {0, 2, 2},
                                     {4, 0, 2},
                                     {1, 1, 1},
                                     {3, 2, 2}}) {
         trial.views.push_back(look(eye, eye + glm::dvec3(1, 0.2, 0.1), 70));
         trial.views.push_back(look(eye, eye + glm::dvec3(-0.3, -1, 0), 70));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
