#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_ten_million({.name = "far_ten_million",
                                 .group = "far",
                                 .breaks = "Ten million units from the origin single precision knows no "
                                           "centimetres, and double barely knows the lattice.",
                                 .faults = {"float-bounds", "float-positions"},
                                 .make = [] {
                                   return house_elsewhere(1, {1e7, -1e7, 1e7});
                                 }});

}  // namespace
}  // namespace triptych::hard_cases
