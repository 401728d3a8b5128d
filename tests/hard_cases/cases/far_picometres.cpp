#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_picometres({.name = "far_picometres",
                                .group = "far",
                                .breaks = "Products of four lengths in units so small vanish in single "
                                          "precision: normals, and with them shades, go.",
                                .faults = {"fixed-units"},
                                .make = [] {
                                  Trial trial;
                                  trial.model = scaled(small_house(), 0x1p-40);
                                  trial.views = scaled(house_views(), 0x1p-40);
                                  trial.twin = std::make_shared<Trial>();
                                  trial.twin->model = small_house();
                                  trial.twin->views = house_views();
                                  return trial;
                                }});

}  // namespace
}  // namespace triptych::hard_cases
