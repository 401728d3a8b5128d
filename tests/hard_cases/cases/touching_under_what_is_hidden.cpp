#include "tests/hard_cases/maker.hpp"
#include "tests/support/object_sets.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery touching_under_what_is_hidden(
    {.name = "touching_under_what_is_hidden",
     .group = "touching",
     .breaks = "Balls beneath shells, and a person hides the shells: levels that leave out what shells cover "
               "would show holes.",
     .faults = {"hollow-levels"},
     .make = [] {
       Trial trial;
       Maker maker;
       std::vector<SourceObjectId> shells;
       for (int i = 0; i < 4; ++i) {
         const glm::dvec3 at(3.0 * i, 0, 0);
         maker.mesh(awkward::sphere(20, 1, at)).mesh(awkward::sphere(17, 0.988, at));
         shells.push_back(2 * static_cast<SourceObjectId>(i));
       }
       trial.model = test::with_objects(maker.model());
       trial.closed = true;
       for (int i = 0; i < 8; ++i) {
         trial.views.push_back(look({4.5 + i, -4.0 - 3 * i, 2}, {4.5, 0, 0}));
         trial.hidden.push_back(shells);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
