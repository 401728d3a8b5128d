#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery far_off_axis(
    {.name = "far_off_axis",
     .group = "far",
     .breaks = "A hundred million units away, beside the axis of a lens and with a near plane of a "
               "nanometre, nothing is left of floats and little of doubles.",
     .faults = {},
     .make = [] {
       Trial trial;
       const glm::dvec3 by(0x1p27, -0x1p27, 0x1p26);
       trial.model = moved(small_house(), by);
       for (int i = 0; i < 6; ++i) {
         View view = look({1 + 0.5 * i, 2.5, 1.5}, {12, 4 + i, 1.25}, 20, {}, 1e-9);
         view.camera.left += 8 * view.camera.right;
         view.camera.right *= 9;
         view.camera.top *= 1.0 + i;
         trial.views.push_back(view);
       }
       trial.views = moved(std::move(trial.views), by);
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
