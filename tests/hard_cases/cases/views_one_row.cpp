#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_one_row({.name = "views_one_row",
                               .group = "views",
                               .breaks = "A picture of 8192 pixels in one row.",
                               .faults = {},
                               .make = [] {
                                 Trial trial;
                                 trial.model = small_house();
                                 for (int i = 0; i < 4; ++i) {
                                   View view = look({1, 2.5 + 0.1 * i, 1.5}, {12, 4, 1.5}, 60, {8192, 1});
                                   set_field_of_view(view.camera, 0.02, 8192);
                                   trial.views.push_back(view);
                                 }
                                 return trial;
                               }});

}  // namespace
}  // namespace triptych::hard_cases
