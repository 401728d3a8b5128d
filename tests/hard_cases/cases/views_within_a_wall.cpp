#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_within_a_wall(
    {.name = "views_within_a_wall",
     .group = "views",
     .breaks =
         "Backs of solids are left out, but who stands inside of one, or has cut it open by the near plane, "
         "sees nothing else.",
     .faults = {"backs-nearby"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.box({-4, 0, -0.5}, {4, 3, 0.5});
       maker.box({-4, 0, -20}, {4, 3, -19.6});
       for (int i = 0; i < 12; ++i) maker.box({-6.0 + i, 0.2, -9.0 - i % 3}, {-5.5 + i, 2, -8.5 - i % 3});
       trial.model = maker.model();
       const glm::dvec3 inside(0.3, 1.5, 0.1);
       for (int i = 0; i < 6; ++i) {
         const glm::dvec3 eye = inside + glm::dvec3(0, 0, 0.2 * i);  // out of the wall at last
         trial.views.push_back(look(eye, eye - glm::dvec3(0.2, 0.1, 1), 80, {96, 80}, 0.05, {0, 1, 0}));
         trial.views.push_back(look(eye, eye + glm::dvec3(1, 0.1, 0.2), 80, {96, 80}, 0.05, {0, 1, 0}));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
