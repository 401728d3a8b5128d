#include "tests/hard_cases/maker.hpp"
#include "tests/support/images.hpp"
#include "tests/support/textured_scene.hpp"

namespace triptych::hard_cases {
namespace {

const InGallery occlusion_behind_a_fence(
    {.name = "occlusion_behind_a_fence",
     .group = "occlusion",
     .breaks =
         "Fences stand before everything, one flush with a wall, one around things, and one as round as a "
         "ball: through their holes everything shows, behind their wires nothing does.",
     .faults = {"opaque-glass"},
     .make = [] {
       Maker maker;
       maker.clutter(60, {2, -5, 0}, {12, 5, 5}, 0.8);
       maker.box({7, -6, -1}, {7.25, 0, 6});
       const size_t solid = 61;
       maker.box({1, -6, -1}, {1.02, 6, 6});
       maker.box({6.98, -6, -1}, {7, 0, 6});  // flush
       maker.box({4, -2, 0}, {6, 2, 3});
       maker.mesh(awkward::sphere(16, 1.2, {9, 3, 2}));
       Trial trial;
       trial.model = maker.model();
       trial.model.images = {
           test::image_of("wire", test::png_file(32, 32, [](uint32_t x, uint32_t y) -> Texel {
                            const bool is_wire = x % 16 < 3 || y % 16 < 3;
                            return {200, 200, 210, static_cast<uint8_t>(is_wire ? 255 : 0)};
                          }))};
       trial.model.materials.push_back({.base_color = {1, 1, 1, 1}, .texture = 0, .cutoff = 0.5f});
       for (size_t i = solid; i < trial.model.meshes.size(); ++i) {
         for (Triangle& triangle : trial.model.meshes[i].triangles)
           triangle.material = static_cast<uint32_t>(trial.model.materials.size() - 1);
         scenes::add_coordinates(trial.model.meshes[i], 0.8);
       }
       for (int i = 0; i < 16; ++i)
         trial.views.push_back(look({-5 + 0.6 * i, 1.5 - 0.2 * i, 2 + 0.1 * i}, {6, 0, 2}));
       return trial;
     }});

}  // namespace
}  // namespace triptych::hard_cases
