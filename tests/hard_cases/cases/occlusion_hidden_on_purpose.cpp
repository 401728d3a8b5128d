#include "tests/hard_cases/maker.hpp"
#include "tests/support/object_sets.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_hidden_on_purpose(
    {.name = "occlusion_hidden_on_purpose",
     .group = "occlusion",
     .breaks =
         "A person hides the wall before everything, and every second thing behind it, from one frame to "
         "the next: what is not there hides nothing.",
     .faults = {"hidden-occludes"},
     .make = [] {
       Maker maker;
       // About as many triangles as a leaf holds, so that the wall is drawn by itself, and hidden as a whole.
       std::vector<SourceObjectId> wall;
       for (int i = 0; i < 4; ++i) {
         wall.push_back(static_cast<SourceObjectId>(i));
         maker.box({0, -6 + 3 * i, -2}, {0.25, -3 + 3 * i, 8});
       }
       maker.clutter(60, {2, -5, 0}, {12, 5, 5}, 0.8);
       Trial trial;
       trial.model = test::with_objects(maker.model());
       const auto count = static_cast<SourceObjectId>(trial.model.source_objects.objects.size());
       std::vector<SourceObjectId> every_second;
       for (SourceObjectId id = 0; id < count; id += 2) every_second.push_back(id);
       for (int i = 0; i < 18; ++i) {
         trial.views.push_back(look({-6 + 0.05 * i, 0.4, 2}, {6, 0, 2}));
         trial.hidden.push_back(i % 3 == 0   ? std::vector<SourceObjectId>()
                                : i % 3 == 1 ? wall
                                             : every_second);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
