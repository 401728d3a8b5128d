// Surfaces in one plane: what lies on others shows, from everywhere and at every level.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <glm/gtc/matrix_transform.hpp>

namespace triptych {
namespace {

using test::pack_of;

constexpr Kept nothing = {.touching = false, .order = false, .planes = false, .cover = false};

/// A slab of 16 x 16 that is blue, under a red finish of 15 x 15 in tiles of different triangulations, with a
/// strip of green paint on it, all flush at z = 0; turned by `turned`.
Model floors(const Affine& turned) {
  std::vector<Mesh> meshes = {awkward::box({-8, -8, -0.5}, {8, 8, 0}, 0)};
  for (int i = 0; i < 25; ++i) {
    Mesh tile = awkward::grid(static_cast<uint32_t>(1 + i % 7), 3);
    for (glm::dvec3& position : tile.positions)
      position += glm::dvec3(3 * (i % 5) - 7.5, 3 * (i / 5) - 7.5, 0);
    for (Triangle& triangle : tile.triangles) triangle.material = 1;
    meshes.push_back(std::move(tile));
  }
  Mesh paint = awkward::grid(9, 1);
  for (glm::dvec3& position : paint.positions) position = {14 * position.x - 7, 2 * position.y - 1, 0};
  for (Triangle& triangle : paint.triangles) triangle.material = 2;
  meshes.push_back(std::move(paint));
  for (Mesh& mesh : meshes) {
    for (glm::dvec3& position : mesh.positions) position = turned * glm::dvec4(position, 1);
  }
  Model model = awkward::model_of(std::move(meshes));
  model.materials = {
      {.base_color = {0, 0, 1, 1}}, {.base_color = {1, 0, 0, 1}}, {.base_color = {0, 1, 0, 1}}};
  return model;
}

struct Wrong {
  size_t pixels = 0, looked_at = 0;
};

/// From the nearest border of tiles.
double seam_distance(double x) { return std::abs(std::remainder(x - 7.5, 3.0)); }

/// Pixels well within the finish that show the slab, and within the paint that show something else.
Wrong wrong_pixels(const Pack& pack, const Affine& turned, double pixel_error, bool orthographic) {
  constexpr int width = 240, height = 180;
  LocalPipeline pipeline(pack, {.width = width, .height = height, .device = test::device()});
  const glm::dmat3 linear(turned);
  Wrong wrong;
  for (uint32_t i = 0; i < 40; ++i) {
    const double turn = 0.4 * i, far = 6 + 1.1 * i, low = i % 3 == 0 ? 0.04 : 0.5;
    const glm::dvec3 eye = turned * glm::dvec4(far * std::cos(turn), far * std::sin(turn), low * far, 1);
    View view{.camera = {.eye = eye, .target = turned[3], .up = linear[2], .near = 0.01},
              .width = width,
              .height = height};
    if (orthographic) {
      set_orthographic_height(view.camera, 12, double(width) / height);
    } else {
      set_field_of_view(view.camera, 50, double(width) / height);
    }
    pipeline.draw({i, {view, pixel_error}});
    const std::vector<uint8_t> colors = pipeline.target().read_colors();
    // Where the middle of each pixel meets the plane.
    const glm::dmat3 rotation = view.rotation();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const glm::dvec3 across((x + 0.5) / view.focal_x() + view.camera.left,
                                (y + 0.5) / view.focal_y() + view.camera.bottom, orthographic ? 0 : -1);
        const glm::dvec3 from = orthographic ? eye + glm::transpose(rotation) * across : eye;
        const glm::dvec3 along = glm::transpose(rotation) * (orthographic ? glm::dvec3(0, 0, -1) : across);
        const glm::dmat3 back = glm::inverse(linear);
        const glm::dvec3 start = back * (from - turned[3]), step = back * along;
        if (!(start.z > 0 && step.z < 0)) continue;
        const glm::dvec3 met = start - step * (start.z / step.z);
        // What a pixel spans there, at most, and twice as much again for the error.
        const double span =
            (2 + 2 * pixel_error) * glm::length(met - start) / view.focal_y() * -glm::length(step) / step.z;
        const double reach = orthographic ? (2 + 2 * pixel_error) / view.focal_y() * -1 / step.z : span;
        if (std::max(std::abs(met.x), std::abs(met.y)) > 7.5 - reach) continue;
        // Between tiles there may be pinholes, and nothing is drawn before the near plane.
        if (seam_distance(met.x) < reach || seam_distance(met.y) < reach || glm::distance(met, start) < 0.5)
          continue;
        const uint8_t* color = &colors[4 * static_cast<size_t>(y * width + x)];
        const bool on_paint = std::abs(met.x) < 7 - reach && std::abs(met.y) < 1 - reach;
        ++wrong.looked_at;
        wrong.pixels += color[2] > 0 || (on_paint && color[1] == 0);
      }
    }
  }
  return wrong;
}

Affine oblique() {
  Affine turned(glm::dmat3(glm::rotate(glm::dmat4(1), 0.7, glm::normalize(glm::dvec3(1, 2, 3)))));
  turned[3] = {310.7, -45.3, 12.9};
  return turned;
}

TEST(OnePlane, shows_what_lies_on_top_from_everywhere_and_at_every_level) {
  for (const Affine& turned : {Affine(1), oblique()}) {
    const auto pack = pack_of(floors(turned));
    for (const double pixel_error : {0.0, 1.0, 3.0}) {
      for (const bool orthographic : {false, true}) {
        const Wrong wrong = wrong_pixels(*pack, turned, pixel_error, orthographic);
        EXPECT_EQ(wrong.pixels, 0u) << pixel_error << (orthographic ? " orthographic" : "");
        EXPECT_GT(wrong.looked_at, 2'000u);
      }
    }
  }
}

/// A slab with a carpet and panels, all flush, under things that stand about: seen from far away all of it is
/// a heap, whose points are brought together.
Model furnished_floor() {
  Model model;
  const auto add = [&](const glm::dvec3& lo, const glm::dvec3& hi, uint32_t material) {
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    model.meshes.push_back(awkward::box(lo, hi, material));
  };
  add({-10, -10, -0.3}, {10, 10, 0}, 0);
  add({-4, -3, -0.02}, {4, 3, 0}, 1);
  for (int i = 0; i < 40; ++i) {
    const double x = 2.4 * (i % 8) - 9.4, y = (i / 8 % 2 == 0 ? 4 : -8) + 1.3 * (i / 16);
    add({x, y, -0.02}, {x + 1.2, y + 1, 0}, 1);
  }
  std::mt19937 random(9);
  const auto number = [&](double lo, double hi) {
    return lo + (hi - lo) * static_cast<double>(random() % 10000) / 10000;
  };
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 at(number(-9, 9), number(-9, 9), number(0.3, 6));
    const double half = number(0.03, 0.15);
    add(at - half, at + half, 2);
  }
  model.materials = {
      {.base_color = {0, 0, 1, 1}}, {.base_color = {1, 0, 0, 1}}, {.base_color = {0, 1, 0, 1}}};
  return model;
}

TEST(OnePlane, keeps_what_lies_on_top_from_far_away) {
  const auto pack = pack_of(furnished_floor());
  constexpr int size = 256;
  LocalPipeline pipeline(*pack, {.width = size, .height = size, .device = test::device()});
  uint32_t frame = 0;
  for (const double pixel_error : {1.0, 2.0, 4.0, 8.0}) {
    for (int i = 0; i < 10; ++i) {
      const double far = 30 + 10 * i;
      View view{.camera = {.eye = {0.6 * far, 0.5 * far, far},
                           .target = glm::dvec3(0),
                           .up = {0, 1, 0},
                           .near = 0.05},
                .width = size,
                .height = size};
      set_field_of_view(view.camera, 60, 1);
      const auto red_pixels = [&](double error) {
        pipeline.draw({frame++, {view, error}});
        const std::vector<uint8_t> colors = pipeline.target().read_colors();
        double red = 0;
        for (size_t k = 0; k < colors.size(); k += 4)
          red += colors[k] > 0 && colors[k + 1] == 0 && colors[k + 2] == 0;
        return red;
      };
      const double whole = red_pixels(0), kept = red_pixels(pixel_error);
      if (whole < 150) continue;
      EXPECT_GT(kept, 0.85 * whole) << pixel_error << " px, " << far;
      EXPECT_LT(kept, 1.2 * whole) << pixel_error << " px, " << far;
    }
  }
}

TEST(OnePlane, without_layers_shows_whatever_comes_first) {
  const auto pack = pack_of(floors(Affine(1)), Simplifier::collapse, nothing);
  EXPECT_GT(wrong_pixels(*pack, Affine(1), 0, false).pixels, 1000u);
}

}  // namespace
}  // namespace triptych
