// Small things keep their cover: what is let into walls, what stands on each other, what has colours of
// vertices.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "visibility/shading.hpp"

namespace triptych {
namespace {

using test::pack_of;

void append(const Mesh& mesh, Mesh& to) {
  const auto first = static_cast<uint32_t>(to.positions.size());
  to.positions.insert(to.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (Triangle triangle : mesh.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    to.triangles.push_back(triangle);
  }
}

void paint(Model& model) {
  model.materials = {
      {.base_color = {0, 0, 1, 1}}, {.base_color = {1, 0, 0, 1}}, {.base_color = {0, 1, 0, 1}}};
}

/// Houses of 10 x 6 x 8, 16 rows of 16, with red windows that stand 3 cm out of the walls and 2 cm in them.
Model town() {
  Mesh house = awkward::box({0, 0, 0}, {10, 6, 8}, 0);
  for (int i = 0; i < 8; ++i) {
    const double x = 1 + 2 * (i % 4), y = 1 + 3 * (i / 4);
    append(awkward::box({x, y, -0.03}, {x + 1, y + 1.3, 0.02}, 1), house);
    append(awkward::box({x, y, 7.98}, {x + 1, y + 1.3, 8.03}, 1), house);
  }
  Model model = awkward::model_of({house});
  model.instances.clear();
  for (int i = 0; i < 256; ++i)
    model.instances.push_back({0, awkward::translation({18.0 * (i % 16) - 144, 0, -16.0 * (i / 16)})});
  paint(model);
  return model;
}

/// A front of red bars, 20 on each other and 40 side by side.
Model bars() {
  Model model = awkward::model_of({awkward::box({-0.03, 0, -0.06}, {0.03, 3.5, 0.06}, 1)});
  model.instances.clear();
  for (int i = 0; i < 800; ++i)
    model.instances.push_back({0, awkward::translation({1.5 * (i % 40) - 30, 3.5 * (i / 40) - 35, 0})});
  paint(model);
  return model;
}

/// Panes between mullions of 6 cm, 40 by 20, and a slab behind them.
Model curtain_wall() {
  Model model = awkward::model_of({awkward::box({-0.03, 0, -0.06}, {0.03, 3.5, 0.06}, 1),
                                   awkward::box({0, -0.03, -0.05}, {1.5, 0.03, 0.05}, 1),
                                   awkward::box({0.03, 0.03, -0.012}, {1.47, 3.47, 0.012}, 0)});
  model.instances.clear();
  for (uint32_t mesh = 0; mesh < 3; ++mesh) {
    for (int i = 0; i < 800; ++i)
      model.instances.push_back({mesh, awkward::translation({1.5 * (i % 40) - 30, 3.5 * (i / 40) - 35, 0})});
  }
  paint(model);
  return model;
}

struct Drawn {
  double red = 0;
  std::vector<uint8_t> colors = {};
  uint64_t triangles = 0;
};

class FromAfar {
 public:
  explicit FromAfar(std::unique_ptr<Pack> pack)
      : pack_(std::move(pack)),
        pipeline_(*pack_, {.width = size, .height = size, .device = test::device()}) {}

  Drawn draw(const Camera& camera, double pixel_error) {
    View view{.camera = camera, .width = size, .height = size};
    set_field_of_view(view.camera, 60, 1);
    const FrameRecord& record = pipeline_.draw({frame_++, {view, pixel_error}});
    Drawn drawn{.triangles = record.drawn_triangles};
    drawn.colors = pipeline_.target().read_colors();
    const std::vector<uint8_t>& colors = drawn.colors;
    for (size_t k = 0; k < colors.size(); k += 4)
      drawn.red += colors[k] > 0 && colors[k + 1] == 0 && colors[k + 2] == 0;
    return drawn;
  }

  static constexpr int size = 256;

 private:
  std::unique_ptr<Pack> pack_;
  LocalPipeline pipeline_;
  uint32_t frame_ = 0;
};

/// The least share of red pixels that is kept, from places further and further away.
double least_kept(const Model& model, const Kept& keep, const glm::dvec3& way, double nearest, int places,
                  uint64_t* triangles = nullptr) {
  FromAfar afar(pack_of(model, Simplifier::collapse, keep));
  double least = 1;
  for (int i = 0; i < places; ++i) {
    const double far = nearest * std::pow(1.15, i);
    const Camera camera{.eye = way * far + glm::dvec3(0.02 * i, 2, 0), .up = {0, 1, 0}, .near = 0.05};
    const Drawn whole = afar.draw(camera, 0), kept = afar.draw(camera, 1);
    if (triangles) *triangles += kept.triangles;
    if (whole.red > 200) least = std::min(least, kept.red / whole.red);
  }
  return least;
}

/// Pixels that show the background within what has surfaces all around in the whole picture, a million of
/// those that have.
double holes(const Model& model, const Kept& keep, double nearest, int places) {
  BuildOptions options;
  options.keep = keep;
  FromAfar afar(test::built(model, options));
  constexpr size_t row = FromAfar::size;
  double within = 0, open = 0;
  for (int i = 0; i < places; ++i) {
    const Camera camera{.eye = {3.0 * i, -10, nearest * std::pow(1.15, i)}, .up = {0, 1, 0}, .near = 0.05};
    const Drawn whole = afar.draw(camera, 0), kept = afar.draw(camera, 1);
    const auto is_empty = [](const Drawn& drawn, size_t pixel) {
      return std::equal(background_bytes.begin(), background_bytes.end(), &drawn.colors[4 * pixel]);
    };
    for (size_t pixel = row + 1; pixel + row + 1 < row * row; ++pixel) {
      bool inside = true;
      for (const size_t first : {pixel - row - 1, pixel - 1, pixel + row - 1})
        for (size_t k = first; k < first + 3; ++k) inside = inside && !is_empty(whole, k);
      within += inside;
      open += inside && is_empty(kept, pixel);
    }
  }
  return open / within * 1e6;
}

TEST(SmallThings, panes_between_mullions_thinner_than_a_pixel_let_little_sky_through) {
  const double kept = holes(curtain_wall(), {}, 30, 10),
               loose = holes(curtain_wall(), {.touching = false}, 30, 10);
  EXPECT_LT(kept, 200);
  EXPECT_LT(20 * kept, loose);
}

TEST(SmallThings, windows_in_walls_stay_before_them) {
  EXPECT_GT(least_kept(town(), {}, {0.1, 0.3, 0.9}, 30, 10), 0.85);
}

TEST(SmallThings, bars_on_each_other_become_one_bar) {
  uint64_t merged = 0, apart = 0;
  EXPECT_GT(least_kept(bars(), {}, {0.2, 0.1, 1}, 20, 16, &merged), 0.85);
  least_kept(bars(), {.touching = false}, {0.2, 0.1, 1}, 20, 16, &apart);
  EXPECT_LT(merged, apart);
}

}  // namespace
}  // namespace triptych
