#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_up_along_the_view(
    {.name = "views_up_along_the_view",
     .group = "views",
     .breaks = "An up vector a millionth of a degree from the view direction leaves next to nothing to build "
               "a rotation from.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({2, 2.5, 1.5}, {12, 4, 1.25}, 60, {}, 0.01,
                                    glm::dvec3(10, 1.5, -0.25) + glm::dvec3(0, 1e-7 * i, 1e-7)));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
