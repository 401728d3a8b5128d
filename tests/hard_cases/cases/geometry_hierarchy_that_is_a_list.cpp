#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_hierarchy_that_is_a_list(
    {.name = "geometry_hierarchy_that_is_a_list",
     .group = "geometry",
     .breaks = "Each object is half as large as the one around it, and lies in its corner: halving the space "
               "gives a list.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int i = 0; i < 24; ++i) maker.box(glm::dvec3(0), glm::dvec3(std::exp2(4.0 - i)));
       trial.model = maker.model();
       trial.build.leaf_triangles = 12;
       trial.views = around({0, 0, 0}, 30, 4);
       for (int i = 0; i < 8; ++i)
         trial.views.push_back(
             look(glm::dvec3(-std::exp2(2.0 - 2 * i)), glm::dvec3(1), 60, {}, std::exp2(-3.0 - 2 * i)));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
