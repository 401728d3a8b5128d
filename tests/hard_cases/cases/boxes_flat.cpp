#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_flat(
    {.name = "boxes_flat",
     .group = "boxes",
     .breaks = "Boxes flat in one dimension have no volume and, seen from the side, no area.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = scenes::make("flat");
       trial.views = around({0, 0, 0}, 12, 6);
       trial.views.push_back(look({0, 0, 0}, {1, 0, 0}));
       trial.views.push_back(look({0, -14, 0}, {0, 0, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
