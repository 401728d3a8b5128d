#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery sections_open_a_house(
    {.name = "sections_open_a_house",
     .group = "sections",
     .breaks = "What a section cuts away stood before all else one frame ago, and must hide nothing now.",
     .faults = {"cut-occludes"},
     .make = [] {
       Trial trial;
       trial.model = small_house();
       const auto section = [&](const glm::dvec3& normal, double offset) -> Section& {
         trial.sections.emplace_back().add_plane({normal, offset}, "test");
         return trial.sections.back();
       };
       trial.sections.emplace_back();  // whole
       section({0, 1, 0}, 4);
       section({0, -1, 0}, -4).add_plane({{1, 0, 0}, 3}, "test");
       trial.sections.emplace_back();
       section({0, 0, -1}, -2);
       section({0.6, 0.8, 0}, 6);
       section({0, 0, 1}, 0).set_box({{2, 1, 0}, {9, 6, 3}}, "test");
       for (int i = 0; i < 14; ++i)
         trial.views.push_back(look({8.0 + 0.2 * i, -9, 4}, {8, 4, 1.5}, 60, {96, 72}));
       const std::vector<View> walk = house_views();
       trial.views.insert(trial.views.end(), walk.begin(), walk.end());
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
