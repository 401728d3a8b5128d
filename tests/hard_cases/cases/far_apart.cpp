#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_apart(
    {.name = "far_apart",
     .group = "far",
     .breaks = "Two clusters a million times further apart than they are wide share one lattice.",
     .faults = {"uncounted-lattice"},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.clutter(30, glm::dvec3(0), glm::dvec3(1), 0.3, 2);
       maker.clutter(30, glm::dvec3(1e6, 1e6, 0), glm::dvec3(1e6 + 1, 1e6 + 1, 1), 0.3, 3);
       trial.model = maker.model();
       trial.views = around(glm::dvec3(0.5), 2, 3);
       for (View& view : around(glm::dvec3(1e6 + 0.5, 1e6 + 0.5, 0.5), 2, 3)) trial.views.push_back(view);
       trial.views.push_back(look({-1, -1, 1}, {1e6, 1e6, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
