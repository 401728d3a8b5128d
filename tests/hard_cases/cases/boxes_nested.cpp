#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_nested({.name = "boxes_nested",
                              .group = "boxes",
                              .breaks = "A hundred boxes around each other: every test but the first is of a "
                                        "box whose content is hidden by its own neighbours.",
                              .faults = {},
                              .make = [] {
                                Trial trial;
                                Maker maker;
                                for (int i = 1; i <= 100; ++i)
                                  maker.box(glm::dvec3(-0.1 * i), glm::dvec3(0.1 * i));
                                trial.model = maker.model();
                                trial.build.leaf_triangles = 12;
                                trial.views = around({0, 0, 0}, 30, 4);
                                trial.views.push_back(look({5.05, 5.05, 0}, {0, 0, 0}));
                                return trial;
                              }});

}  // namespace
}  // namespace triptych::hard_cases
