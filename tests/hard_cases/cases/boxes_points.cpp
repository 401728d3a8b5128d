#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_points({.name = "boxes_points",
                              .group = "boxes",
                              .breaks = "Triangles of one lattice step each: boxes that are points.",
                              .faults = {},
                              .make = [] {
                                Trial trial;
                                Maker maker;
                                Random random(6);
                                maker.box({-3, -3, -3}, {3, -2.5, 3});
                                for (int i = 0; i < 80; ++i) {
                                  const glm::dvec3 at = random.vector(-3, 3);
                                  maker.triangle(at, at + glm::dvec3(2e-7, 0, 0),
                                                 at + glm::dvec3(0, 2e-7, 2e-7));
                                }
                                trial.model = maker.model();
                                trial.build.leaf_triangles = 1;
                                trial.views = around({0, 0, 0}, 9, 4);
                                trial.views.push_back(look({0, 1e-3, 0}, {1, 0, 0}, 60, {}, 1e-6));
                                return trial;
                              }});

}  // namespace
}  // namespace triptych::hard_cases
