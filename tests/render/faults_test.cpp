// Each fault that is put in on purpose shows in the comparison with the un-culled picture: the comparison can
// fail.
#include "base/inject.hpp"
#include "tests/render/rig.hpp"
#include "tests/support/scenes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

/// Frames of the scene that differ from the un-culled picture.
size_t wrong_frames(const std::string& scene) {
  constexpr int width = 320, height = 240;
  const Pack& pack = scenes::pack(scene);
  Rig rig(pack, width, height);
  const std::vector<View> views = scenes::path(pack.skeleton(), width, height);
  size_t wrong = 0;
  for (size_t i = 0; i < views.size(); ++i) {
    const FrameRequest request{static_cast<uint32_t>(i), {views[i], scenes::pixel_error(i)}};
    wrong += rig.draw(request).differing_pixels > 0;
  }
  return wrong;
}

/// Squares smaller than a pixel, each a drawable of its own. Right edges of some pass a pixel's centre by
/// half a step of the rasterizer (1/256 pixel) and next to nothing: whether one shows, and whether its box
/// does, hangs on the last bits of their roundings. Left edges of the others miss it by less than half a
/// step: they are snapped to it, and their boxes are not.
class Specks {
 public:
  Specks() : pack_(write()) {}

  /// How many pixels the culled picture lacks.
  size_t differing_pixels() {
    View view{.camera = {.eye = eye, .target = eye - glm::dvec3(0, 0, 1), .up = {0, 1, 0}},
              .width = side,
              .height = side};
    view.camera.left = view.camera.bottom = -0.5;
    view.camera.right = view.camera.top = 0.5;
    return Rig(pack_, side, side).draw({0, view, 1}).differing_pixels;
  }

 private:
  static constexpr int side = 256, rows = 20;
  static constexpr double distance = 16, pixel = distance / side;
  static constexpr glm::dvec3 eye{0.2718281828, -0.1414213562, distance};

  static std::filesystem::path write() {
    test::SmallPack pack = test::small_pack();
    Skeleton& skeleton = pack.skeleton;
    skeleton.lattices = {Lattice{{0, 0, 0}, 0x1p-24}};
    skeleton.transforms = {Affine(1)};
    skeleton.scene_nodes = {{.box = {}, .first_child = 1, .child_count = rows * rows}};
    skeleton.placements.clear();
    skeleton.drawables.clear();
    pack.chunks.clear();
    for (uint32_t i = 0; i < rows * rows; ++i) {
      const glm::dvec3 center =
          eye + pixel * glm::dvec3(12.0 * (i % rows) - 119.5, 12.0 * (i / rows) - 119.5, -side);
      const double past = 0.5 / 256 + (i % 41) * 0x1p-20;
      const double left = i % 2 == 0 ? -0.3 : past / 2, right = i % 2 == 0 ? past : 0.3;
      const glm::ivec3 lo = skeleton.lattice().nearest(center + pixel * glm::dvec3(left, -0.3, 0));
      const glm::ivec3 hi = skeleton.lattice().nearest(center + pixel * glm::dvec3(right, 0.3, 0));
      Chunk chunk;
      chunk.vertices = {{lo, 0}, {{hi.x, lo.y, lo.z}, 0}, {hi, 0}, {{lo.x, hi.y, lo.z}, 0}};
      chunk.indices = {0, 1, 2, 0, 2, 3};
      skeleton.scene_nodes.push_back(
          {.box = chunk.box(), .parent = 0, .first_drawable = i, .drawable_count = 1});
      skeleton.scene_nodes[0].box.extend(chunk.box());
      skeleton.placements.push_back({i, 0});
      skeleton.drawables.push_back(
          {.error = 0, .scene_node = i + 1, .first_placement = i, .placement_count = 1, .triangles = 2});
      pack.chunks.push_back(std::move(chunk));
    }
    pack.chunk_lattices.assign(pack.chunks.size(), 0);
    return test::write_pack(pack);
  }

  Pack pack_;
};

/// Faults that show together, and scenes in one of which they show at least.
struct Trial {
  std::vector<std::string> faults;
  std::vector<std::string> scenes;
};

class Faults : public testing::TestWithParam<Trial> {
 protected:
  ~Faults() override { clear_injected(); }
};

TEST_P(Faults, change_pictures) {
  for (const std::string& scene : GetParam().scenes)
    EXPECT_EQ(wrong_frames(scene), 0u) << scene << " without the fault";
  for (const std::string& fault : GetParam().faults) ASSERT_TRUE(inject(fault));
  size_t wrong = 0;
  for (const std::string& scene : GetParam().scenes) wrong += wrong_frames(scene);
  EXPECT_GT(wrong, 0u);
  RecordProperty("wrong_frames", std::to_string(wrong));
}

TEST(NoDilation, loses_specks_whose_box_covers_no_pixel) {
  Specks specks;
  EXPECT_EQ(specks.differing_pixels(), 0u) << "without the fault";
  ASSERT_TRUE(inject("no-dilation"));
  const size_t lost = specks.differing_pixels();
  clear_injected();
  EXPECT_GT(lost, 0u);
  RecordProperty("lost_pixels", std::to_string(lost));
}

// A strict test alone changes nothing, because the margin of depth keeps a box before its own content;
// without that margin it does.
INSTANTIATE_TEST_SUITE_P(Injected, Faults,
                         testing::Values(Trial{{"withheld-id"}, {"room"}}, Trial{{"stale-camera"}, {"room"}},
                                         Trial{{"wrong-ancestor"}, {"slivers", "world", "coplanar"}},
                                         Trial{{"strict-depth-test", "no-dilation"},
                                               {"coplanar", "flat", "room", "world"}}),
                         [](const auto& parameter) {
                           std::string name;
                           for (const std::string& fault : parameter.param.faults)
                             name += (name.empty() ? "" : "_and_") + fault;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace triptych
