// Box tests against every pixel's depth, by brute force.
#include "raster/box_test.hpp"

#include "raster/instruction_set.hpp"
#include "tests/raster/opaque_palette.hpp"
#include "tests/support/scenes.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using scenes::Random;

/// A buffer with triangles of one chunk in it.
class Scene {
 public:
  Scene(int width, int height, uint32_t seed, bool depth_alone) : buffer(width, height, depth_alone, 1) {
    Random random(seed);
    skeleton.lattices.push_back({glm::dvec3(0), 1.0 / 1024});
    skeleton.transforms.push_back(Affine(1.0));
    skeleton.scene_nodes.push_back({.box = {glm::ivec3(-100000), glm::ivec3(100000)}});
    View view{.camera = {}, .width = width, .height = height};
    set_field_of_view(view.camera, 60, static_cast<double>(width) / height);
    const FrameView frame(skeleton, {view});
    Chunk chunk;
    for (int i = 0; i < 60; ++i) {
      const glm::dvec3 at(random.number(-3, 3), random.number(-3, 3), random.number(-9, -2));
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 p = (at + random.vector(-1, 1)) * 1024.0;
        chunk.indices.push_back(static_cast<uint32_t>(chunk.vertices.size()));
        chunk.vertices.push_back({glm::ivec3(p)});
      }
    }
    const RasterChunk geometry(chunk, test::opaque_palette);
    const BoxProjector projector(frame, raster_margins);
    const GeometryTerms terms(frame, projector);
    LatticePlacer placer(skeleton);
    placer.begin(frame);
    const LatticeBox all = skeleton.scene_nodes[0].box;
    const PlacedStretch stretch{.rank = {},
                                .chunk = &geometry,
                                .triangle_count = static_cast<uint32_t>(chunk.triangle_count()),
                                .placed = placer.place(0, 0),
                                .pieces = std::span(&all, 1)};
    buffer.draw(terms, std::span(&stretch, 1));
  }

  Skeleton skeleton;
  VisibilityBuffer buffer;
};

TEST(BoxTest, says_what_a_look_at_every_pixel_says) {
  size_t shown = 0, hidden = 0, hidden_by_tiles = 0;
  for (const auto& [width, height] : {std::pair(64, 64), {61, 37}, {7, 5}, {1, 1}, {200, 3}, {150, 140}}) {
    const Scene scene(width, height, 1, false), depths(width, height, 1, true);
    Random random(2);
    for (int i = 0; i < 1000; ++i) {
      ScreenRectangle rectangle;
      rectangle.left = static_cast<float>(random.number(-1, 1));
      rectangle.bottom = static_cast<float>(random.number(-1, 1));
      rectangle.right = std::min(1.0f, rectangle.left + static_cast<float>(random.number(0, 0.5)));
      rectangle.top = std::min(1.0f, rectangle.bottom + static_cast<float>(random.number(0, 0.5)));
      for (DepthPlane& plane : rectangle.planes) {
        plane.middle = static_cast<float>(random.number(0, 0.01));
        if (i % 2 == 0 && &plane != &rectangle.planes[0])
          plane.slope = {static_cast<float>(random.number(-0.01, 0.01)),
                         static_cast<float>(random.number(-0.01, 0.01))};
      }
      if (i % 3 == 0) {
        for (HalfPlane& cut : rectangle.cuts) {
          cut.normal = {static_cast<float>(random.number(-1, 1)), static_cast<float>(random.number(-1, 1))};
          cut.offset = static_cast<float>(random.number(-0.3, 1));
        }
      }
      uint32_t expected[2] = {0, 0};
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const double ndc_x = (2 * x + 1.0) / width - 1, ndc_y = (2 * y + 1.0) / height - 1;
          const float fx = static_cast<float>(2 * x + 1) / static_cast<float>(width) - 1,
                      fy = static_cast<float>(2 * y + 1) / static_cast<float>(height) - 1;
          if (ndc_x < rectangle.left || ndc_x > rectangle.right || ndc_y < rectangle.bottom ||
              ndc_y > rectangle.top || !(rectangle.depth(fx, fy) >= 0))
            continue;
          bool inside = true;
          for (const HalfPlane& cut : rectangle.cuts) inside = inside && cut.at(fx, fy) >= 0;
          if (!inside) continue;
          expected[0] += rectangle.depth(fx, fy) >= scene.buffer.depth(x, y);
          expected[1] += rectangle.depth(fx, fy) > scene.buffer.depth(x, y);
        }
      }
      for (const InstructionSet set : instruction_sets_here()) {
        force_instruction_set(set);
        for (const VisibilityBuffer* buffer : {&scene.buffer, &depths.buffer}) {
          for (const bool strict : {false, true}) {
            const uint32_t pixels = expected[strict];
            for (const uint32_t enough : {1u, 2u, 7u, std::max(pixels, 1u), pixels + 1, 1000000u}) {
              ASSERT_EQ(count_pixels(*buffer, rectangle, strict, enough), std::min(pixels, enough))
                  << width << "x" << height << " " << i << " " << instruction_set_name(set);
            }
            const ScreenExtent sides{rectangle.left, rectangle.bottom, rectangle.right, rectangle.top,
                                     rectangle.planes[0].middle};
            const bool known = hides(*buffer, sides, strict);
            ASSERT_FALSE(known && pixels > 0) << width << "x" << height << " " << i;
            hidden_by_tiles += known;
          }
        }
      }
      force_instruction_set(std::nullopt);
      ++(expected[0] > 0 ? shown : hidden);
    }
  }
  EXPECT_GT(shown, 500u);
  EXPECT_GT(hidden, 500u);
  EXPECT_GT(hidden_by_tiles, 500u);
}

TEST(BoxTest, a_box_at_the_very_depth_that_is_there_shows_and_strictly_it_does_not) {
  const Scene scene(64, 64, 3, true);
  size_t looked = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float there = scene.buffer.depth(x, y);
      if (there == 0) continue;
      ScreenRectangle rectangle;
      rectangle.left = rectangle.right = (2 * static_cast<float>(x) + 1) / 64 - 1;
      rectangle.bottom = rectangle.top = (2 * static_cast<float>(y) + 1) / 64 - 1;
      rectangle.planes[0].middle = there;
      EXPECT_EQ(count_pixels(scene.buffer, rectangle, false, 2), 1u);
      EXPECT_EQ(count_pixels(scene.buffer, rectangle, true, 2), 0u);
      ++looked;
    }
  }
  EXPECT_GT(looked, 500u);
}

}  // namespace
}  // namespace triptych
