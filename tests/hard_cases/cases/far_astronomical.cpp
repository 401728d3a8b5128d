#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_astronomical({.name = "far_astronomical",
                                  .group = "far",
                                  .breaks = "Products of four lengths in units of a parsec overflow single "
                                            "precision: normals, and with them shades, go.",
                                  .faults = {},
                                  .make = [] { return house_elsewhere(0x1p55); }});

}  // namespace
}  // namespace triptych::hard_cases
