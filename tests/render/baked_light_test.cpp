// Surfaces in baked light, and in ambient occlusion: pictures against what is known of the scene, levels of
// detail, and the effects' place in a frame.
#include "scene/effects.hpp"
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/shading.hpp"

#include <array>
#include <cmath>
#include <embree3/rtcore.h>
#include <map>

namespace triptych {
namespace {

using test::pack_of;

constexpr int side = 64;

/// A floor of 8 units around the origin, z up, a board over it, and a light over that: what its irradiance on
/// the floor is, is known.
constexpr double board_half = 0.75, board_height = 2, light_height = 3;

Model lit_floor() {
  Mesh floor = awkward::grid(1, 8);
  for (glm::dvec3& position : floor.positions) position += glm::dvec3(-4, -4, 0);
  Model model = awkward::model_of({floor, awkward::box({-board_half, -board_half, board_height},
                                                       {board_half, board_half, board_height + 0.05})});
  for (Material& material : model.materials) material.base_color = {0.5f, 0.5f, 0.5f, 1};
  ModelLight light;
  light.position = {0, 0, light_height};
  light.intensity = {100, 100, 50};
  model.lights = {light};
  return model;
}

LightOptions baked(bool ambient = false) {
  LightOptions options;
  options.bake = !ambient;
  options.ambient = ambient;
  options.samples = 32;
  options.bounces = 0;
  options.shortest_edge = 1.0 / 256;
  return options;
}

/// A picture of the floor from far above: a pixel is an eighth of a unit.
struct Seen {
  std::vector<uint8_t> colors;
  FrameRecord record;
  std::array<int, 3> at(int x, int y) const {
    const uint8_t* const pixel = &colors[4 * static_cast<size_t>(y * side + x)];
    return {pixel[0], pixel[1], pixel[2]};
  }
};
Seen look(const Pack& pack, Effects effects = Effects::all(), double pixel_error = 0) {
  View view{.camera = {.eye = {0, 0, 400}, .target = {0, 0, 0}, .up = {0, 1, 0}, .near = 0.1},
            .width = side,
            .height = side};
  set_field_of_view(view.camera, 2 * std::atan(4.0 / 400) * 180 / std::acos(-1.0), 1);
  LocalPipeline pipeline(pack, {.width = side, .height = side, .device = test::device()});
  Seen seen;
  FrameState state{.view = view, .pixel_error = pixel_error};
  state.effects = effects;
  seen.record = pipeline.draw({0, state});
  seen.colors = pipeline.target().read_colors();
  return seen;
}

const Pack& lit_pack() {
  static const std::unique_ptr<Pack> pack = pack_of(lit_floor(), Simplifier::collapse, {}, baked());
  return *pack;
}

double shown(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Relative to the light straight below the lamp if nothing stood between, by rays of Embree's own, from the
/// floor to the lamp, past the board.
class Judge {
 public:
  Judge() : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    RTCGeometry quad = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_QUAD);
    auto* const corners = static_cast<float*>(
        rtcSetNewGeometryBuffer(quad, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 4));
    constexpr float h = board_half, z = board_height;
    const float places[4][3] = {{-h, -h, z}, {h, -h, z}, {h, h, z}, {-h, h, z}};
    std::copy(&places[0][0], &places[0][0] + 12, corners);
    auto* const indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(quad, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT4, 4 * sizeof(uint32_t), 1));
    for (uint32_t i = 0; i < 4; ++i) indices[i] = i;
    rtcCommitGeometry(quad);
    rtcAttachGeometry(scene_, quad);
    rtcReleaseGeometry(quad);
    rtcCommitScene(scene_);
  }
  ~Judge() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  double irradiance(double x, double y) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray{};
    ray.org_x = static_cast<float>(x);
    ray.org_y = static_cast<float>(y);
    ray.dir_x = static_cast<float>(-x);
    ray.dir_y = static_cast<float>(-y);
    ray.dir_z = light_height;
    ray.tfar = 1;
    ray.mask = ~0u;
    rtcOccluded1(scene_, &context, &ray);
    if (ray.tfar < 0) return 0;
    const double r = std::sqrt(x * x + y * y + light_height * light_height);
    return std::pow(light_height / r, 3);
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

TEST(BakedLight, is_what_rays_from_the_floor_to_the_lamp_say) {
  const Seen seen = look(lit_pack());
  const Judge judge;
  // Exposure is one factor for the whole picture: that of a place in the light.
  constexpr int lit_x = 8, lit_y = 32;
  const auto place = [](int pixel) { return (pixel + 0.5) / 8 - 4; };
  const auto expected_at = [&](int x, int y, double factor, int channel) {
    return 255 *
           shown(std::min(1.0, factor * (channel == 2 ? 0.5 : 1) * judge.irradiance(place(x), place(y))));
  };
  double low = 0, high = 4;  // of the factor, by halves
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (expected_at(lit_x, lit_y, middle, 0) < seen.at(lit_x, lit_y)[0] ? low : high) = middle;
  }
  size_t judged = 0, wrong = 0, dark = 0;
  for (int y = 0; y < side; y += 2) {
    for (int x = 0; x < side; x += 2) {
      if (std::abs(place(x)) < board_half + 0.3 && std::abs(place(y)) < board_half + 0.3)
        continue;  // the board
      const double here = judge.irradiance(place(x), place(y));
      const double aside = 0.1;  // the shadow's edge is as wide as the shortest edges
      bool even = true;
      for (const auto& [dx, dy] :
           {std::pair{aside, aside}, {-aside, aside}, {aside, -aside}, {-aside, -aside}})
        even = even && (judge.irradiance(place(x) + dx, place(y) + dy) > 0) == (here > 0);
      if (!even) continue;
      ++judged;
      dark += here == 0;
      bool right = true;
      for (int k = 0; k < 3; ++k)
        right = right && std::abs(expected_at(x, y, low, k) - seen.at(x, y)[static_cast<size_t>(k)]) <= 6;
      wrong += !right;
    }
  }
  EXPECT_GT(judged, 500u);
  EXPECT_GT(dark, 10u);
  EXPECT_LE(wrong, judged / 50);
}

TEST(BakedLight, is_named_by_the_frame_and_can_be_switched_off) {
  const Seen seen = look(lit_pack());
  ASSERT_EQ(seen.record.effects.size(), 1u);
  EXPECT_EQ(seen.record.effects[0].effect, Effect::baked_light);
  const Seen without = look(lit_pack(), Effects::none());
  EXPECT_TRUE(without.record.effects.empty());
  Model plain = lit_floor();
  plain.lights.clear();
  const Seen same = look(*pack_of(plain));
  EXPECT_EQ(without.colors, same.colors);
}

TEST(BakedLight, of_coarse_levels_is_near_that_of_full_detail) {
  const Seen fine = look(lit_pack()), coarse = look(lit_pack(), Effects::all(), 4);
  EXPECT_LT(coarse.record.drawn_triangles, fine.record.drawn_triangles);
  double sum = 0;
  for (size_t i = 0; i < fine.colors.size(); ++i) sum += std::abs(fine.colors[i] - coarse.colors[i]);
  EXPECT_LT(sum / static_cast<double>(fine.colors.size()), 4);
}

TEST(BakedLight, models_without_emitters_have_the_same_pack_whether_it_is_asked_for_or_not) {
  Model plain = lit_floor();
  plain.lights.clear();
  const auto with = pack_of(plain, Simplifier::collapse, {}, baked()), without = pack_of(plain);
  EXPECT_EQ(with->content_hash(), without->content_hash());
}

TEST(AmbientOcclusion, darkens_what_is_beneath_and_leaves_what_is_open) {
  const auto pack = pack_of(lit_floor(), Simplifier::collapse, {}, baked(true));
  const Seen with = look(*pack), without = look(*pack, Effects::none());
  ASSERT_EQ(with.record.effects.size(), 1u);
  EXPECT_EQ(with.record.effects[0].effect, Effect::ambient);
  // In the corner nothing is near; the board's own top is open, too.
  for (const auto& [x, y] : {std::pair{2, 2}, {32, 32}}) {
    for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(with.at(x, y)[k], without.at(x, y)[k], 1) << x << " " << y;
  }
  Model covered = lit_floor();  // a board close above the floor, larger than what it hides from the eye
  LightOptions options = baked(true);
  options.reach = 0.2;
  covered.meshes[1] = awkward::box({-4, -0.25, 0.5}, {4, 0.25, 0.6});
  const auto beside = pack_of(covered, Simplifier::collapse, {}, options);
  const Seen shaded = look(*beside), even = look(*beside, Effects::none());
  constexpr int next_to_board = 35;  // an eighth of a unit beyond its edge
  EXPECT_LT(shaded.at(32, next_to_board)[1], even.at(32, next_to_board)[1] - 10);
}

}  // namespace
}  // namespace triptych
