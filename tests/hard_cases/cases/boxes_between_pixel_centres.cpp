#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery boxes_between_pixel_centres(
    {.name = "boxes_between_pixel_centres",
     .group = "boxes",
     .breaks = "Squares that pass a pixel centre by a thousandth of a pixel: whether they show, and whether "
               "their boxes do, hangs on rounding.",
     .faults = {"no-dilation"},
     .make = [] {
       Trial trial;
       constexpr int side = 256, rows = 20;
       constexpr double distance = 16, pixel = 16.0 / side;
       const glm::dvec3 eye(0.2718281828, -0.1414213562, distance);
       Maker maker;
       for (int i = 0; i < rows * rows; ++i) {
         const glm::dvec3 center = eye + pixel * glm::dvec3(12.0 * (i % rows) - 119.5,
                                                            12.0 * (i / rows) - 119.5, -distance / pixel);
         const double past = 0.5 / 256 + (i % 41 - 20) * 0x1p-20;
         // Every other one begins there: what is snapped back to the centre covers it.
         const double left = i % 2 == 0 ? -0.3 : past, right = i % 2 == 0 ? past : 0.6;
         maker.quad(center + pixel * glm::dvec3(left, -0.3, 0), {pixel * (right - left), 0, 0},
                    {0, 0.6 * pixel, 0});
       }
       trial.model = maker.model();
       trial.build.leaf_triangles = 2;
       trial.build.part_triangles = 2;
       for (int i = 0; i < 4; ++i) {
         View view = look(eye, eye - glm::dvec3(0, 0, 1), 60, {side, side}, 0.01, {0, 1, 0});
         view.camera.left = view.camera.bottom = -8 / distance;
         view.camera.right = view.camera.top = 8 / distance;
         view.camera.eye.x += 1e-9 * i;
         view.camera.target.x += 1e-9 * i;
         trial.views.push_back(view);
       }
       trial.pixel_error = 1e-6;
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
