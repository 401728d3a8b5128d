#include "tests/hard_cases/maker.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery views_that_must_be_refused(
    {.name = "views_that_must_be_refused",
     .group = "views",
     .breaks =
         "Cameras of infinite or missing numbers, without direction, without width, narrower than single "
         "precision holds, or wider than it at the picture's aspect: one clear line, before anything starts.",
     .faults = {},
     .make = [] {
       Trial trial;
       trial.model = Maker().box({0, 0, 0}, {1, 1, 1}).model();
       const std::string start = R"({"triptych_path": 1, "frames": [{)", end = R"(}]})";
       for (const char* frame :
            {R"("eye": [1e999,0,0], "target": [0,0,1], "up": [0,1,0])",
             R"("eye": [NaN,0,0], "target": [0,0,1], "up": [0,1,0])",
             R"("eye": [0,0,0], "target": [0,0,0], "up": [0,1,0])",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,0,2])",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "near": 0)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "near": 1e999)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "fov_y_degrees": 180)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "orthographic_height": 0)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "fov_y_degrees": 1e-37)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "orthographic_height": 1e-38)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "orthographic_height": 1.79e308)",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "off_axis": [1, 1, -1, 1])",
             R"("eye": [0,0,0], "target": [0,0,1], "up": [0,1,0], "off_axis": [-1e308, 1e308, -1, 1])"}) {
         trial.refused_paths.push_back(start + frame + end);
       }
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
