#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_smaller_than_any_unit(
    {.name = "far_smaller_than_any_unit",
     .group = "far",
     .breaks =
         "In units of which the house is 1e-38 long, products of eight lengths vanish in double precision.",
     .faults = {"fixed-units"},
     .make = [] { return house_elsewhere(0x1p-130); }});

}  // namespace
}  // namespace triptych::hard_cases
