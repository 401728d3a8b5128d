#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_larger_than_any_unit(
    {.name = "far_larger_than_any_unit",
     .group = "far",
     .breaks =
         "In units of which the house is 1e49 long, products of seven lengths are beyond double precision.",
     .faults = {"fixed-units"},
     .make = [] { return house_elsewhere(0x1p160); }});

}  // namespace
}  // namespace triptych::hard_cases
