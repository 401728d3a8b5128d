#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_sheared({.name = "geometry_sheared",
                                  .group = "geometry",
                                  .breaks = "A transform whose axes nearly coincide brings far-apart points "
                                            "together: sums that cancel, in which a float loses the object.",
                                  .faults = {"shared-shears"},
                                  .make = [] {
                                    Trial trial;
                                    trial.thin = true;
                                    const glm::dmat3 shear(glm::dvec3(1, 0, 0), glm::dvec3(1, 1e-6, 0),
                                                           glm::dvec3(0, 0, 1));
                                    Mesh mesh = awkward::box({-2, -2, -2}, {2, 2, 2});
                                    for (glm::dvec3& p : mesh.positions) p = glm::inverse(shear) * p;
                                    Maker maker;
                                    Random random(17);
                                    maker.mesh(mesh, Affine(shear[0], shear[1], shear[2], glm::dvec3(0)));
                                    for (int i = 0; i < 150; ++i)
                                      maker.place(
                                          Affine(shear[0], shear[1], shear[2], random.vector(-20, 20)));
                                    trial.model = maker.model();
                                    trial.build.leaf_triangles = 12;
                                    trial.build.part_triangles = 12;
                                    trial.pixel_error = 0.001;
                                    trial.views = around({0, 0, 0}, 60, 10, 30, {256, 256}, 0.1);
                                    return trial;
                                  }});

}  // namespace
}  // namespace triptych::hard_cases
