#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

MotionTrack turns(std::vector<double> times, std::vector<double> angles, double length) {
  MotionTrack track{.components = 4, .length = length, .times = std::move(times), .values = {}};
  for (const double angle : angles)
    track.values.insert(track.values.end(), {0, 0, std::sin(angle / 2), std::cos(angle / 2)});
  return track;
}

const InGallery occlusion_by_a_door_that_moves(
    {.name = "occlusion_by_a_door_that_moves",
     .group = "occlusion",
     .breaks =
         "A door in a wall opens and closes, between frames too, with a sign that it carries; behind it "
         "things slide past, grow and turn: each hides and shows where it is in this frame.",
     .faults = {"stale-motion"},
     .make = [] {
       Maker maker;
       maker.box({0, -8, -1}, {0.25, -2, 6}).box({0, 2, -1}, {0.25, 8, 6}).box({0, -2, 4}, {0.25, 2, 6});
       maker.clutter(60, {2, -5, 0}, {12, 5, 5}, 0.8).keep();
       // The door, about its hinge.
       const MotionTrack swings = turns({0, 1, 2, 3}, {0, 1.7, 1.7, 0}, 4);
       maker.box({0, 0, -1}, {0.25, 4, 4});
       const uint32_t door =
           maker.move({.before = linear({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -2, 0})}, nullptr, &swings);
       // A sign that slides on the door: carried by what moves.
       const MotionTrack slides{
           .length = 1.5, .times = {0, 0.75, 1.5}, .values = {0, 0.5, 0, 0, 3, 2, 0, 0.5, 0}};
       maker.keep().box({-0.2, 0, 0}, {-0.05, 0.8, 0.6});
       maker.move({.parent = door}, &slides, nullptr);
       // What passes behind the door, finely divided, turning and growing as it goes.
       const MotionTrack passes{
           .interpolation = Interpolation::cubic_spline,
           .length = 3,
           .times = {0, 1.5, 3},
           .values = {0, 0, 0, 4, -7, 1, 2, 9, 0, 0, 9, 2, 3, 0, 3, 0, 9, 2, 2, 9, 0, 4, 7, 1, 0, 0, 0}};
       const MotionTrack rolls = turns({0, 1, 2}, {0, 2, 4}, 2);
       const MotionTrack grows{.interpolation = Interpolation::step,
                               .length = 2,
                               .times = {0, 0.5, 1.2},
                               .values = {1, 1, 1, 0.5, 0.5, 2, -1.4, 1.4, 1.4}};
       maker.keep().mesh(awkward::sphere(12, 1)).box({1, 1, -0.2}, {3, 1.4, 0.2});
       maker.move({}, &passes, &rolls, &grows);
       maker.keep();
       Trial trial;
       trial.model = maker.model();
       for (int i = 0; i < 24; ++i) {
         trial.views.push_back(look({-5 + 0.05 * i, 0.4, 2}, {6, 0.2 * (i % 5), 2}));
         trial.times.push_back(i < 16 ? 1.3 + 0.27 * i : 17.3 * (i % 4) + 0.5);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
