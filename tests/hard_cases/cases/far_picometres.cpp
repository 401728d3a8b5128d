#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_picometres({.name = "far_picometres",
                                .group = "far",
                                .breaks = "Products of four lengths in units so small vanish in single "
                                          "precision: normals, and with them shades, go.",
                                .faults = {},
                                .make = [] { return house_elsewhere(0x1p-40); }});

}  // namespace
}  // namespace triptych::hard_cases
