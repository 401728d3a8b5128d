#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery depth_near_plane_just_behind_a_floor(
    {.name = "depth_near_plane_just_behind_a_floor",
     .group = "depth",
     .breaks =
         "The near plane lies so little behind a floor that single precision may draw it all the same: the "
         "cut must hold it.",
     .faults = {"exact-frustum"},
     .make = [] {
       Trial trial;
       Maker maker;
       for (int x = -4; x < 4; ++x) {
         for (int y = -4; y < 4; ++y) maker.quad({125.0 * x, 125.0 * y, 0}, {125, 0, 0}, {0, 125, 0});
       }
       maker.box({-500, -500, -300}, {500, 500, -290});
       trial.model = maker.model();
       const glm::dvec3 eye(3, 5, 10.3), target(3, 5, 0), up(0, 1, 0);
       for (int i = 0; i < 12; ++i) {
         trial.views.push_back(look(eye, target, 60, {}, 10.3 * (1 + 1e-8 * i), up));
         trial.views.push_back(look_parallel(eye, target, 900, {}, 10.3 + 4e-6 * i, up));
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
