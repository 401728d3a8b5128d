// The sky behind a model: its colours, its light, and what neither may change.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/shading.hpp"
#include "visibility/sky_look.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace triptych {
namespace {

using test::pack_of;

constexpr int side = 64;

/// A box of one unit in the middle of what a level camera sees.
class SkyPictures : public testing::Test {
 protected:
  SkyPictures()
      : pack(pack_of(awkward::model_of({awkward::grid(1, 1)}))),
        pipeline(*pack, {.width = side, .height = side, .device = test::device()}) {
    state.view = {.camera = {.eye = {0.5, 0.5, 3}, .target = {0.5, 0.5, 0}, .up = {0, 1, 0}, .near = 0.1},
                  .width = side,
                  .height = side};
    set_field_of_view(state.view.camera, 90, 1);
  }
  std::vector<uint8_t> draw(const Sky& sky, Effects effects = Effects::all(), uint32_t samples = 1) {
    state.sky = sky;
    state.effects = effects;
    state.samples = samples;
    record = pipeline.draw({number++, state});
    return pipeline.target().read_colors();
  }
  /// From the lower left corner.
  static std::array<int, 3> at(const std::vector<uint8_t>& colors, int x, int y) {
    const uint8_t* const pixel = &colors[4 * (static_cast<size_t>(y) * side + static_cast<size_t>(x))];
    return {pixel[0], pixel[1], pixel[2]};
  }

  std::unique_ptr<Pack> pack;
  LocalPipeline pipeline;
  FrameState state;
  FrameRecord record;
  uint32_t number = 0;
};

constexpr Sky noon{true, {0, 0.8, -0.6}};

TEST_F(SkyPictures, grow_from_the_horizon_to_the_zenith_over_the_ground) {
  for (const uint32_t samples : {1u, 4u}) {
    const std::vector<uint8_t> colors = draw(noon, Effects::all(), samples);
    const SkyLook look(FrameView(pack->skeleton(), state));
    for (const auto& [x, y] : {std::pair(2, 2), {2, 30}, {2, 33}, {2, 62}, {60, 50}}) {
      const std::array<uint8_t, 4> expected = look.at(x, y);
      for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(at(colors, x, y)[k], expected[k], 1) << x << " " << y;
    }
    EXPECT_NE(at(colors, 2, 30), at(colors, 2, 33)) << "the ground ends at the horizon";
    EXPECT_GT(at(colors, 2, 33)[0], at(colors, 2, 62)[0]) << "higher up it is bluer";
    const auto used = std::ranges::find(record.effects, Effect::sky, &EffectUse::effect);
    ASSERT_NE(used, record.effects.end());
    EXPECT_GT(used->fragments, 0u);
  }
}

TEST_F(SkyPictures, are_as_without_one_where_it_is_off_or_not_asked_for) {
  const std::vector<uint8_t> without = draw({});
  EXPECT_TRUE(record.effects.empty()) << "a frame without a sky pays nothing";
  Effects all_but = Effects(Effects::all().bits() & ~(1u << static_cast<uint32_t>(Effect::sky)));
  EXPECT_EQ(draw(noon, all_but), without);
  EXPECT_EQ(at(without, 2, 2),
            (std::array<int, 3>{background_bytes[0], background_bytes[1], background_bytes[2]}));
  EXPECT_NE(draw(noon), without);
  EXPECT_EQ(draw({}), without) << "nothing is left over from the frame before";
}

TEST_F(SkyPictures, light_faces_by_where_the_sun_is) {
  const auto face = [&](const glm::dvec3& to_sun) { return at(draw({true, to_sun}), side / 2, side / 2)[0]; };
  const int before = face({0, 0.6, 0.8}), above = face({0, 1, 0}), night = face({0, -1, 0}),
            setting = face({0, 0.05, std::sqrt(1 - 0.05 * 0.05)});
  EXPECT_GT(before, above + 20) << "the face looks along z";
  EXPECT_EQ(above, night) << "from there no light comes on it, and at night from nowhere";
  EXPECT_GT(setting, night);
}

TEST_F(SkyPictures, show_the_sun_itself_and_darken_at_night) {
  state.view.camera.target = {0.5, 20, 3 - 26};
  set_field_of_view(state.view.camera, 10, 1);
  const glm::dvec3 there = glm::normalize(state.view.camera.target - state.view.camera.eye);
  const std::vector<uint8_t> day = draw({true, there}), night = draw({true, {there.x, -there.y, there.z}});
  int bright = 0;
  for (int y = 28; y < 36; ++y)
    for (int x = 28; x < 36; ++x) bright += at(day, x, y)[0] > 245;
  EXPECT_GT(bright, 0);
  EXPECT_LT(at(night, 2, 62)[2], 60);
}

}  // namespace
}  // namespace triptych
