#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_micrometres({.name = "far_micrometres",
                                 .group = "far",
                                 .breaks = "A house in micrometres is the same house.",
                                 .faults = {},
                                 .make = [] {
                                   Trial trial;
                                   trial.model = scaled(small_house(), 0x1p20);
                                   trial.views = scaled(house_views(), 0x1p20);
                                   trial.twin = std::make_shared<Trial>();
                                   trial.twin->model = small_house();
                                   trial.twin->views = house_views();
                                   return trial;
                                 }});

}  // namespace
}  // namespace triptych::hard_cases
