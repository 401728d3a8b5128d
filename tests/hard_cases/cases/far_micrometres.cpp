#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_micrometres({.name = "far_micrometres",
                                 .group = "far",
                                 .breaks = "A house in micrometres is the same house.",
                                 .faults = {},
                                 .make = [] { return house_elsewhere(0x1p20); }});

}  // namespace
}  // namespace triptych::hard_cases
