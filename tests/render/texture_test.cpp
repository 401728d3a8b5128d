// What surfaces with textures, holes and light of their own show, and that holes hide nothing.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/images.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/test_device.hpp"
#include "visibility/shading.hpp"

#include <array>
#include <cmath>

namespace triptych {
namespace {

using test::image_of;
using test::pack_of;
using test::png_file;
using Color = std::array<int, 3>;

constexpr int side = 65;

/// Squares of 4 units in planes that face the eye, their textures once over each, the first the lowest.
Model sheets(const std::vector<Material>& materials, std::vector<ModelImage> images) {
  std::vector<Mesh> meshes;
  for (uint32_t i = 0; i < materials.size(); ++i) {
    Mesh mesh = awkward::grid(1, 4);
    for (glm::dvec3& position : mesh.positions) position += glm::dvec3(-2, -2, i);
    for (Triangle& triangle : mesh.triangles) triangle.material = i;
    for (const glm::dvec3& p : mesh.positions)
      mesh.coordinates.push_back(texture_coordinates((p.x + 2) / 4, (2 - p.y) / 4));
    meshes.push_back(std::move(mesh));
  }
  Model model = awkward::model_of(std::move(meshes));
  model.materials = materials;
  model.images = std::move(images);
  return model;
}

View from_above() {
  View view{.camera = {.eye = {0, 0, 400}, .target = {0, 0, 0}, .up = {0, 1, 0}, .near = 0.1},
            .width = side,
            .height = side};
  set_field_of_view(view.camera, 2 * std::atan(2.0 / 400) * 180 / std::acos(-1.0), 1);
  return view;
}

/// What the picture shows at a share of its sides, from its upper left corner.
class Picture {
 public:
  explicit Picture(const Model& model, FrameState state = {}) : pack_(pack_of(model)) {
    state.view = from_above();
    LocalPipeline pipeline(*pack_, {.width = side, .height = side, .device = test::device()});
    record_ = pipeline.draw({0, state});
    colors_ = pipeline.target().read_colors();
  }
  Color at(double x, double y) const {
    const auto column = static_cast<size_t>(x * side), row = static_cast<size_t>((1 - y) * side);
    const uint8_t* const pixel = &colors_[4 * (row * side + column)];
    return {pixel[0], pixel[1], pixel[2]};
  }
  const FrameRecord& record() const { return record_; }

 private:
  std::unique_ptr<Pack> pack_;
  FrameRecord record_;
  std::vector<uint8_t> colors_;
};

void expect_near(const Color& found, const Color& expected, int tolerance, const std::string& what) {
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], tolerance) << what << ", channel " << i;
}

/// A plain colour, as displayed, in the light of these tests.
Color lit(const Color& color) {
  const float light = ambient_light + head_light + diffuse_light * [] {
    const auto pack = pack_of(sheets({{}}, {}));
    const FrameState state{.view = from_above()};
    return std::abs(light_direction(FrameView(pack->skeleton(), state)).z);
  }();
  Color result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = static_cast<int>(std::lround(static_cast<float>(color[i]) * light));
  return result;
}

/// Quarters: red, green, blue, yellow.
Texel quarters(uint32_t x, uint32_t y) {
  const bool right = x >= 8, low = y >= 8;
  return low ? (right ? Texel{220, 200, 20, 255} : Texel{20, 40, 200, 255})
             : (right ? Texel{30, 180, 40, 255} : Texel{200, 20, 30, 255});
}
ModelImage quarters_image() { return image_of("quarters", png_file(16, 16, quarters)); }
/// Solid at the left.
ModelImage half_image() {
  return image_of("half", png_file(16, 16, [](uint32_t x, uint32_t) -> Texel {
                    return {200, 200, 200, static_cast<uint8_t>(x < 8 ? 255 : 0)};
                  }));
}

const Material plain_red{.base_color = {0.5f, 0.02f, 0.02f, 1}};

TEST(Textured, shows_the_image_upright_with_its_colours_in_the_light) {
  const Picture picture(sheets({{.base_color = {1, 1, 1, 1}, .texture = 0}}, {quarters_image()}));
  expect_near(picture.at(0.2, 0.2), lit({200, 20, 30}), 1, "upper left");
  expect_near(picture.at(0.8, 0.2), lit({30, 180, 40}), 1, "upper right");
  expect_near(picture.at(0.2, 0.8), lit({20, 40, 200}), 1, "lower left");
  expect_near(picture.at(0.8, 0.8), lit({220, 200, 20}), 1, "lower right");
  ASSERT_EQ(picture.record().effects.size(), 1u);
  EXPECT_EQ(picture.record().effects[0].effect, Effect::textures);
}

TEST(Textured, multiplies_the_base_colour_in_linear_light) {
  const Picture picture(sheets({{.base_color = {0.5f, 0.25f, 1, 1}, .texture = 0}}, {quarters_image()}));
  // 220 is 0.716 of the light, half of which is 0.358, which is shown as 161; 200, 0.578, a quarter as 104.
  expect_near(picture.at(0.8, 0.8), lit({161, 106, 20}), 2, "yellow times the factor");
}

TEST(Textured, between_texels_is_interpolated_or_not_as_the_sampler_says) {
  for (const bool nearest : {false, true}) {
    const Picture picture(
        sheets({{.base_color = {1, 1, 1, 1}, .texture = 0, .sampler = {.nearest = nearest}}},
               {image_of("two", png_file(2, 1, [](uint32_t x, uint32_t) -> Texel {
                           const auto value = static_cast<uint8_t>(x == 0 ? 0 : 255);
                           return {value, value, value, 255};
                         }))}));
    // Pixels at 0.454 and 0.546 of the width: 0.41 and 0.59 of the light, which are shown as 171 and 202.
    const Color left = nearest ? Color{0, 0, 0} : Color{171, 171, 171},
                right = nearest ? Color{255, 255, 255} : Color{202, 202, 202};
    expect_near(picture.at(0.45, 0.5), lit(left), 2, "left");
    expect_near(picture.at(0.55, 0.5), lit(right), 2, "right");
  }
}

TEST(Textured, far_away_is_the_mean_of_what_a_pixel_covers) {
  Model model = sheets({{.base_color = {1, 1, 1, 1}, .texture = 0}},
                       {image_of("fine", png_file(512, 512, [](uint32_t x, uint32_t y) -> Texel {
                                   const auto value = static_cast<uint8_t>((x + y) % 2 == 0 ? 0 : 255);
                                   return {value, value, value, 255};
                                 }))});
  for (const double at : {0.11, 0.37, 0.5, 0.83})
    expect_near(Picture(model).at(at, at), lit({188, 188, 188}), 2, "half of the light");
}

TEST(Textured, holes_show_what_lies_behind_them_and_hide_nothing_of_it) {
  const Material fence{.base_color = {1, 1, 1, 1}, .texture = 0, .cutoff = 0.5f};
  const Picture picture(sheets({plain_red, fence}, {half_image()}));
  expect_near(picture.at(0.25, 0.5), lit({200, 200, 200}), 1, "solid");
  const Color behind = Picture(sheets({plain_red}, {})).at(0.5, 0.5);
  EXPECT_EQ(picture.at(0.75, 0.5), behind);
  for (const uint32_t samples : {4u, 16u}) {
    FrameState state;
    state.samples = samples;
    EXPECT_EQ(Picture(sheets({plain_red, fence}, {half_image()}), state).at(0.75, 0.5), behind);
  }
  FrameState without;
  without.effects = Effects::none();
  EXPECT_NE(Picture(sheets({plain_red, fence}, {half_image()}), without).at(0.75, 0.5), behind)
      << "without the effect it is solid";
}

TEST(Textured, alpha_of_a_texture_that_blends_lets_through_what_lies_behind) {
  const Material veil{.base_color = {1, 1, 1, 0.5f}, .texture = 0, .blends = true};
  const Picture picture(sheets({plain_red, veil}, {half_image()}));
  const Color behind = Picture(sheets({plain_red}, {})).at(0.5, 0.5), front = lit({200, 200, 200});
  Color mixed;
  for (size_t i = 0; i < 3; ++i) mixed[i] = (front[i] + behind[i]) / 2;
  expect_near(picture.at(0.25, 0.5), mixed, 2, "half covered");
  expect_near(picture.at(0.75, 0.5), behind, 1, "not covered");
}

TEST(Emission, is_shown_in_full_whatever_the_light_does) {
  const Picture picture(sheets({{.base_color = {0, 0, 0, 1}, .emission = {1, 0.2158605f, 0}}}, {}));
  expect_near(picture.at(0.5, 0.5), {255, 128, 0}, 1, "glowing");
  ASSERT_EQ(picture.record().effects.size(), 1u);
  EXPECT_EQ(picture.record().effects[0].effect, Effect::emission);
  FrameState without;
  without.effects = Effects::none();
  EXPECT_EQ(Picture(sheets({{.base_color = {0, 0, 0, 1}, .emission = {1, 1, 1}}}, {}), without).at(0.5, 0.5),
            (Color{0, 0, 0}));
}

TEST(Emission, is_multiplied_by_its_texture_and_added_to_what_is_lit) {
  const Picture picture(sheets({{.base_color = {0, 0, 0, 1}, .emission_texture = 0, .emission = {1, 1, 1}}},
                               {quarters_image()}));
  expect_near(picture.at(0.2, 0.2), {200, 20, 30}, 1, "upper left, without a light");
  const Picture added(sheets({{.base_color = {1, 0, 0, 1}, .emission = {0, 0.5f, 0}}}, {}));
  const Color of_base = lit({255, 0, 0});
  expect_near(added.at(0.5, 0.5), {of_base[0], 188, 0}, 1, "both");
}

}  // namespace
}  // namespace triptych
