#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_ten_million({.name = "far_ten_million",
                                 .group = "far",
                                 .breaks = "Ten million units from the origin single precision knows no "
                                           "centimetres, and double barely knows the lattice.",
                                 .faults = {"float-bounds", "float-positions"},
                                 .make = [] {
                                   Trial trial;
                                   trial.model = moved(small_house(), glm::dvec3(1e7, -1e7, 1e7));
                                   trial.views = moved(house_views(), glm::dvec3(1e7, -1e7, 1e7));
                                   trial.twin = std::make_shared<Trial>();
                                   trial.twin->model = small_house();
                                   trial.twin->views = house_views();
                                   return trial;
                                 }});

}  // namespace
}  // namespace triptych::hard_cases
