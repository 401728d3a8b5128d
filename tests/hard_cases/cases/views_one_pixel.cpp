#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_one_pixel({.name = "views_one_pixel",
                                 .group = "views",
                                 .breaks = "A picture of a single pixel: everything is below a pixel, and "
                                           "margins reach over the whole picture.",
                                 .faults = {},
                                 .make = [] {
                                   Trial trial;
                                   trial.model = Maker().clutter(60, {-4, -4, -4}, {4, 4, 4}, 0.3, 8).model();
                                   trial.build.leaf_triangles = 12;
                                   trial.pixel_error = 0.01;
                                   trial.slivers = true;  // in a picture of one pixel
                                   trial.views = around({0, 0, 0}, 0.5, 12, 170, {1, 1});
                                   return trial;
                                 }});

}  // namespace
}  // namespace triptych::hard_cases
