#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_limits_of_double({.name = "far_limits_of_double",
                                      .group = "far",
                                      .breaks = "At 1e15 units doubles are an eighth apart: the lattice is "
                                                "as coarse as that, and must say so in its errors.",
                                      .faults = {},
                                      .make = [] {
                                        Trial trial;
                                        const glm::dvec3 far(1e15, -1e15, 5e14);
                                        trial.model = moved(
                                            Maker().clutter(40, glm::dvec3(0), glm::dvec3(60), 20).model(),
                                            far);
                                        trial.views = moved(around(glm::dvec3(30), 110, 6, 60, {}, 1), far);
                                        return trial;
                                      }});

}  // namespace
}  // namespace triptych::hard_cases
