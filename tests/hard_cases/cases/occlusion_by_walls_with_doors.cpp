#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

/// Three rooms in a row and one above, each with something in it, and doors between them that do not line up.
Model rooms() {
  Maker maker;
  for (const double z : {-0.25, 3.0, 6.25}) maker.box({0, 0, z}, {15, 5, z + 0.25});
  for (const double y : {0.0, 4.75}) maker.box({0, y, 0}, {15, y + 0.25, 6.25});
  for (const double x : {0.0, 14.75}) maker.box({x, 0, 0}, {x + 0.25, 5, 6.25});
  for (int i = 1; i < 3; ++i) {
    const double x = 5 * i, door = i == 1 ? 1 : 3;
    maker.box({x, 0, 0}, {x + 0.125, door, 3}).box({x, door + 1, 0}, {x + 0.125, 5, 3});
    maker.box({x, door, 2}, {x + 0.125, door + 1, 3});
  }
  for (int i = 0; i < 3; ++i)
    maker.clutter(40, {0.5 + 5 * i, 0.5, 0}, {4 + 5 * i, 4, 2.5}, 0.5, static_cast<uint32_t>(i + 1));
  maker.clutter(60, {0.5, 0.5, 3.25}, {14, 4, 5.5}, 0.7, 9);
  // Things that lean on a wall, on both of its sides.
  maker.box({4.5, 2.5, 0}, {5, 4.5, 1}).box({5.125, 2.5, 0}, {5.5, 4.5, 1.5});
  return snapped(maker.model(), 0x1p-12);
}

const InGallery occlusion_by_walls_with_doors(
    {.name = "occlusion_by_walls_with_doors",
     .group = "occlusion",
     .breaks =
         "Rooms are seen through a door, through two, through none; the eye goes through a door, along a "
         "wall, and into it, where the near plane cuts it away.",
     .faults = {"walls-before-near"},
     .make = [] {
       Trial trial;
       trial.model = rooms();
       trial.pixel_error = 2;
       for (int i = 0; i < 6; ++i)
         trial.views.push_back(look({1 + 0.1 * i, 1.5, 1.5}, {8, 1.5 + 0.2 * i, 1.25}, 60));
       for (int i = 0; i < 6; ++i)  // through the first door
         trial.views.push_back(look({4.8 + 0.1 * i, 1.5, 1.25}, {10, 3.5, 1.25}, 75));
       for (int i = 0; i < 4; ++i)  // into the second wall
         trial.views.push_back(look({9.6 + 0.11 * i, 1.5, 1.5}, {14, 2.5, 1.5}, 60, {}, 0.25));
       for (const glm::dvec3& eye : {glm::dvec3(-4, 2, 2), glm::dvec3(7, 2, 12), glm::dvec3(7, 2, 5)})
         trial.views.push_back(look(eye, {8, 2.5, 1}, 60));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
