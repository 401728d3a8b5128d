// Closed surfaces in many parts, seen from inside at mixed levels of detail: a pixel of the background would
// be a hole.
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <array>
#include <glm/glm.hpp>
#include <map>
#include <set>

namespace triptych {
namespace {

using test::holes_of_random_mixes;
using test::inside;
using test::pack_of;
using test::random_mix;

class ClosedBorders : public testing::Test {
 protected:
  ClosedBorders() : pack(pack_of(awkward::model_of({awkward::wavy_sphere(120)}))) {}

  /// Drawables of how many levels of the hierarchy the cut mixes.
  size_t mixed_levels(const Cut& cut) const {
    std::set<std::pair<uint32_t, uint32_t>> levels;
    for (const DrawableId id : cut.drawables) {
      const Skeleton& skeleton = pack->skeleton();
      const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[id].scene_node];
      levels.insert({node.child_count == 0, id - node.first_drawable});
    }
    return levels.size();
  }

  std::unique_ptr<Pack> pack;
};

TEST_F(ClosedBorders, no_pixel_shows_what_is_behind_a_closed_surface_at_any_mix_of_levels) {
  LocalPipeline pipeline(*pack, {.width = 320,
                                 .height = 240,
                                 .cull = StrategyKind::frustum,
                                 .device = test::device(),
                                 .item_buffer = true});
  size_t holes = 0, mixed = 0, frames = 0;
  for (const double pixel_error : {0.5, 2.0, 8.0, 24.0}) {
    for (int i = 0; i < 24; ++i) {
      const View view = inside(i * 0.71, 320, 240);
      const FrameRequest frame{static_cast<uint32_t>(frames++), {view, pixel_error}};
      mixed += mixed_levels(select_cut(FrameView(pack->skeleton(), frame.state))) > 1;
      pipeline.draw(frame);
      for (const uint32_t item : pipeline.target().read_items()) holes += item == 0;
    }
  }
  EXPECT_EQ(holes, 0u);
  EXPECT_GT(mixed, frames / 2);
}

TEST_F(ClosedBorders, no_pixel_shows_through_whatever_level_each_part_is_drawn_at) {
  EXPECT_EQ(holes_of_random_mixes(*pack, 120), 0u);
}

/// Every edge must be passed as often one way as the other: then the surface has no border anywhere.
TEST_F(ClosedBorders, random_mixes_of_levels_have_no_open_edge) {
  std::mt19937 random(5);
  for (int i = 0; i < 30; ++i) {
    std::map<std::array<int, 6>, int> balance;
    for (const DrawableId id : random_mix(pack->skeleton(), random)) {
      const Drawable& drawable = pack->skeleton().drawables[id];
      for (uint32_t k = 0; k < drawable.placement_count; ++k) {
        const Chunk chunk = pack->read_chunk(pack->skeleton().placements[drawable.first_placement + k].chunk);
        for (size_t corner = 0; corner < chunk.indices.size(); ++corner) {
          const glm::ivec3 a = chunk.vertices[chunk.indices[corner]].point;
          const glm::ivec3 b = chunk.vertices[chunk.indices[corner % 3 == 2 ? corner - 2 : corner + 1]].point;
          ++balance[{a.x, a.y, a.z, b.x, b.y, b.z}];
          --balance[{b.x, b.y, b.z, a.x, a.y, a.z}];
        }
      }
    }
    size_t open = 0;
    for (const auto& [edge, count] : balance) open += count != 0;
    EXPECT_EQ(open, 0u) << "mix " << i;
  }
}

TEST(ClosedBorder, is_closed_at_any_mix_whoever_simplified_it) {
  for (const Simplifier simplifier : {Simplifier::openmesh, Simplifier::meshopt}) {
    const auto pack = pack_of(awkward::model_of({awkward::wavy_sphere(80)}), simplifier);
    EXPECT_EQ(holes_of_random_mixes(*pack, 40), 0u)
        << (simplifier == Simplifier::meshopt ? "meshopt" : "openmesh");
  }
}

TEST(ClosedBorder, of_placed_meshes_stays_closed_between_their_own_levels_and_those_of_whole_subtrees) {
  Model model = awkward::model_of({awkward::wavy_sphere(80)});
  const double turn = 0.83;
  Affine placed = awkward::translation({31.7, -2.3, 8.9});
  placed[0] = 1.3 * glm::dvec3(std::cos(turn), std::sin(turn), 0);
  placed[1] = 1.3 * glm::dvec3(-std::sin(turn), std::cos(turn), 0);
  placed[2] = {0, 0, -1.3};  // mirrored
  model.instances = {{0, Affine(1)}, {0, placed}};
  const auto pack = pack_of(model);
  EXPECT_EQ(holes_of_random_mixes(*pack, 40), 0u);
  EXPECT_EQ(holes_of_random_mixes(*pack, 80, placed), 0u);
}

TEST(ClosedBorder, without_a_part_shows_holes) {
  const auto pack = pack_of(awkward::model_of({awkward::wavy_sphere(80)}));
  LocalPipeline pipeline(*pack, {.width = 320, .height = 240, .device = test::device(), .item_buffer = true});
  size_t holes = 0;
  for (int i = 0; i < 40; ++i) {
    std::mt19937 random(21);
    std::vector<DrawableId> mix = random_mix(pack->skeleton(), random);
    mix.erase(mix.begin() + i % static_cast<int>(mix.size()));
    pipeline.picture().begin(FrameView(pack->skeleton(), {inside(i * 0.71, 320, 240)}),
                             static_cast<uint32_t>(i));
    pipeline.picture().draw(mix);
    pipeline.picture().finish();
    for (const uint32_t item : pipeline.target().read_items()) holes += item == 0;
  }
  EXPECT_GT(holes, 0u);
}

}  // namespace
}  // namespace triptych
