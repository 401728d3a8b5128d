#include "tests/hard_cases/maker.hpp"

#include <cmath>

namespace triptych::hard_cases {
namespace {

const InGallery geometry_singular_quadrics(
    {.name = "geometry_singular_quadrics",
     .group = "geometry",
     .breaks = "Planar, linear and single-point pieces: every quadric is singular, and any point of a plane "
               "is as good as any other.",
     .faults = {},
     .make = [] {
       Trial trial;
       Maker maker;
       maker.mesh(awkward::grid(16, 4, 0));
       Mesh fan{"fan", {{0, 0, 2}}, {}};
       for (uint32_t i = 0; i < 40; ++i) {
         fan.positions.push_back({std::cos(0.16 * i), std::sin(0.16 * i), 2});
         if (i > 0) fan.triangles.push_back({{0, i, i + 1}, 0});
       }
       maker.mesh(fan);
       Mesh ribbon{"ribbon", {}, {}};
       for (uint32_t i = 0; i < 60; ++i) {
         ribbon.positions.push_back({0.1 * i - 3, 3, 1});
         ribbon.positions.push_back({0.1 * i - 3, 3 + 1e-6, 1});
         if (i > 0) ribbon.triangles.push_back({{2 * i - 2, 2 * i - 1, 2 * i}, 0});
       }
       maker.mesh(ribbon);
       trial.model = maker.model();
       trial.pixel_error = 3;
       trial.views = around({1, 2, 1}, 6, 8);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
