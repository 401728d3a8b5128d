#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_below_a_pixel({.name = "boxes_below_a_pixel",
                                     .group = "boxes",
                                     .breaks = "Objects smaller than a pixel, before and behind a wall.",
                                     .faults = {},
                                     .make = [] {
                                       Trial trial;
                                       trial.model = scenes::make("dust");
                                       trial.build.leaf_triangles = 12;
                                       trial.views = around({0, 0, 0}, 13, 8);
                                       return trial;
                                     }});

}  // namespace
}  // namespace triptych::hard_cases
