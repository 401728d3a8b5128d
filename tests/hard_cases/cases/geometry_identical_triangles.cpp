#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery geometry_identical_triangles(
    {.name = "geometry_identical_triangles",
     .group = "geometry",
     .breaks = "A million times the same triangle in one place: nothing to divide, nothing to "
               "simplify, everything at equal depth.",
     .faults = {},
     .make = [] {
       Trial trial;
       Mesh mesh{"stack", {{0, 0, 0}, {2, 0, 0}, {0, 2, 0.5}}, {}};
       mesh.triangles.assign(1'000'000, {{0, 1, 2}, 0});
       Maker maker;
       maker.mesh(mesh);
       maker.triangle({0, 0, 0}, {2, 0, 0}, {0, 2, 0.5});
       const Affine twice = linear({2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {3, 0, 0});
       for (int i = 0; i < 100; ++i) maker.place(twice);
       trial.model = maker.model();
       trial.views = around({1, 1, 0}, 5, 6);
       trial.views.push_back(look({2, 1, 9}, {2, 1, 0}, 60, {}, 0.01, {0, 1, 0}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
