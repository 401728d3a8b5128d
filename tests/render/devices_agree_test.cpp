// The rasteriser's pictures beside OpenGL's: neither is held to the other's bits, and both draw the same.
#include "lod/cut.hpp"
#include "nodes/pack_device.hpp"
#include "tests/support/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

namespace triptych {
namespace {

struct Differences {
  size_t coverage = 0;  ///< something here, background there
  size_t owner = 0;     ///< another drawable
  size_t color = 0;     ///< the same one, more than 1 of 255 apart; where there are textures, 3
};

class DevicesAgree : public testing::TestWithParam<std::string> {
 protected:
  static constexpr int width = 512, height = 512;

  Differences compare(const FrameView& view) {
    std::vector<DrawableId> cut = select_cut(view).drawables;
    sort_by_rank(pack.skeleton(), view.cell, cut);
    for (FrameTarget* target : {cpu_target.get(), gl_target.get()}) {
      target->begin(view);
      target->draw(cut);
      target->finish();
    }
    const auto items = cpu_target->read_items(), gl_items = gl_target->read_items();
    const auto colors = cpu_target->read_colors(), gl_colors = gl_target->read_colors();
    const int alike = pack.skeleton().textures.empty() ? 1 : 3;
    Differences found;
    for (size_t i = 0; i < items.size(); ++i) {
      if ((items[i] == 0) != (gl_items[i] == 0)) {
        ++found.coverage;
      } else if (items[i] != gl_items[i]) {
        ++found.owner;
      } else {
        int largest = 0;
        for (size_t channel = 4 * i; channel < 4 * i + 4; ++channel)
          largest = std::max(largest, std::abs(int{colors[channel]} - int{gl_colors[channel]}));
        found.color += largest > alike;
      }
    }
    return found;
  }

  const Pack& pack = scenes::pack(GetParam());
  ChosenDevice opengl = choose_device({DeviceKind::gl});
  PackDevice cpu{pack, {DeviceKind::cpu}}, gl{pack, opengl.options};
  std::unique_ptr<FrameTarget> cpu_target =
                                   cpu.device().make_target(TargetKind::color_and_item, width, height),
                               gl_target = gl.device().make_target(TargetKind::color_and_item, width, height);
};

TEST_P(DevicesAgree, in_coverage_to_a_few_pixels_and_in_colours_but_where_planes_coincide) {
  const Box box = pack.skeleton().lattice().box(pack.skeleton().scene_nodes[0].box);
  const glm::dvec3 middle = (box.lo + box.hi) * 0.5;
  // How far neighbouring pixels look on a texture is a difference on OpenGL, and a slope of the plane here:
  // at edges of holes, and where that changes fast, they mix other levels.
  const bool textured = !pack.skeleton().textures.empty();
  Differences sum;
  size_t frames = 0;
  // Around the model and through it, as a person would look at it.
  for (; frames < 24; ++frames) {
    const double turn = 0.7 * static_cast<double>(frames), away = frames % 3 == 0 ? 0.2 : 0.8;
    View view{
        .camera = {.eye = middle + away * pack.skeleton().diagonal() *
                                       glm::dvec3(std::cos(turn), 0.3 * std::sin(2.1 * turn), std::sin(turn)),
                   .target = middle,
                   .near = pack.skeleton().default_near()},
        .width = width,
        .height = height};
    set_field_of_view(view.camera, 60, 1);
    const Differences found = compare(FrameView(pack.skeleton(), {view, 1}));
    EXPECT_LE(found.coverage, textured ? 200u : 20u) << "frame " << frames;
    sum.coverage += found.coverage;
    sum.owner += found.owner;
    sum.color += found.color;
  }
  RecordProperty("coverage", std::to_string(sum.coverage));
  RecordProperty("owner", std::to_string(sum.owner));
  RecordProperty("color", std::to_string(sum.color));
  const size_t pixels = frames * width * height;
  EXPECT_LE(sum.owner, pixels / 1000);
  EXPECT_LE(sum.color, pixels / (textured ? 30 : 2000));
}

TEST_P(DevicesAgree, in_edges_of_one_sample_and_of_several_but_for_a_few_pixels) {
  const Box box = pack.skeleton().lattice().box(pack.skeleton().scene_nodes[0].box);
  size_t different = 0, edges = 0;
  for (const uint32_t samples : {1u, 4u, 8u}) {
    View view{.camera = {.eye = box.lo + (box.hi - box.lo) * glm::dvec3(-0.4, 0.3, 1.3),
                         .target = (box.lo + box.hi) * 0.5,
                         .near = pack.skeleton().default_near()},
              .width = width,
              .height = height};
    if (samples == 8)
      set_orthographic_height(view.camera, pack.skeleton().diagonal(), 1);
    else
      set_field_of_view(view.camera, 60, 1);
    const auto colors_with = [&](FrameTarget& target, bool with_edges) {
      const FrameView frame(pack.skeleton(), {view, 1, samples, with_edges});
      std::vector<DrawableId> cut = select_cut(frame).drawables;
      sort_by_rank(pack.skeleton(), frame.cell, cut);
      target.begin(frame);
      target.draw(cut);
      target.finish();
      return target.read_colors();
    };
    const auto plain = colors_with(*cpu_target, false), on_cpu = colors_with(*cpu_target, true),
               plain_on_gl = colors_with(*gl_target, false), on_gl = colors_with(*gl_target, true);
    const auto apart = [](const std::vector<uint8_t>& one, const std::vector<uint8_t>& other, size_t i) {
      return std::abs(int{one[i]} - int{other[i]}) > 24 || std::abs(int{one[i + 1]} - int{other[i + 1]}) > 24;
    };
    for (size_t i = 0; i < plain.size(); i += 4) {
      if (apart(plain, plain_on_gl, i)) continue;  // where planes coincide
      different += apart(on_cpu, on_gl, i);
      edges += apart(on_cpu, plain, i);
    }
  }
  RecordProperty("different", std::to_string(different));
  RecordProperty("edges", std::to_string(edges));
  EXPECT_GT(edges, 0u);
  EXPECT_LE(different, edges / 50);
}

// Not slivers, whose coverage is up to how finely a device snaps corners. Not dust, where a pixel is a
// drawable. Coplanar faces are what differs there.
INSTANTIATE_TEST_SUITE_P(Scenes, DevicesAgree,
                         testing::Values("room", "flat", "world", "instances", "far", "storeys", "painted",
                                         "smooth", "textured", "triangle"),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace triptych
