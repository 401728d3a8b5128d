// What is transparent: what it shows behind it, in which order, and that it hides nothing.
#include "lod/cut.hpp"
#include "preprocess/encode_chunk.hpp"
#include "raster/raster_device.hpp"
#include "render/gl/renderer.hpp"
#include "render/gl/resolve_pass.hpp"
#include "residency/load_on_demand.hpp"
#include "tests/render/closed_scenes.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "tests/support/scenes.hpp"
#include "visibility/shading.hpp"

#include <cmath>

namespace triptych {
namespace {

using test::pack_of;
using Color = std::array<int, 3>;

/// A square that faces the eye, at this height above the plane z = 0.
struct Pane {
  double height;
  glm::vec4 color;
};

constexpr int side = 33;

Model panes(const std::vector<Pane>& all) {
  std::vector<Mesh> meshes;
  Model model;
  for (const Pane& pane : all) {
    Mesh mesh = awkward::grid(1, 4);
    for (glm::dvec3& position : mesh.positions) position += glm::dvec3(-2, -2, pane.height);
    for (Triangle& triangle : mesh.triangles) triangle.material = static_cast<uint32_t>(meshes.size());
    meshes.push_back(std::move(mesh));
  }
  model = awkward::model_of(std::move(meshes));
  model.materials.clear();
  for (const Pane& pane : all) model.materials.push_back({.base_color = pane.color});
  return model;
}

View from_above() {
  View view{.camera = {.eye = {0.01, 0.02, 10}, .target = {0.01, 0.02, 0}, .up = {0, 1, 0}, .near = 0.1},
            .width = side,
            .height = side};
  set_field_of_view(view.camera, 12, 1);
  return view;
}

/// What the middle of the picture shows.
Color middle(const Model& model, const FrameState& wanted = {}) {
  const auto pack = pack_of(model);
  FrameState state = wanted;
  state.view = from_above();
  LocalPipeline pipeline(*pack, {.width = side, .height = side, .device = test::device()});
  pipeline.draw({0, state});
  const std::vector<uint8_t> colors = pipeline.target().read_colors();
  const size_t at = 4 * (side / 2 * side + side / 2);
  return {colors[at], colors[at + 1], colors[at + 2]};
}

/// Opaque, in the light of the test.
Color lit(const glm::vec4& color) { return middle(panes({{0, {color.r, color.g, color.b, 1}}})); }

Color over(const Color& front, float alpha, const Color& behind) {
  Color result;
  for (size_t i = 0; i < 3; ++i)
    result[i] = static_cast<int>(std::lround(alpha * float(front[i]) + (1 - alpha) * float(behind[i])));
  return result;
}

void expect_near(const Color& found, const Color& expected, const std::string& what) {
  for (size_t i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1) << what << ", channel " << i;
}

/// As the palette holds it.
float stored(float alpha) { return std::round(alpha * 255) / 255; }

const glm::vec4 red{0.8, 0.1, 0.1, 1}, green{0.1, 0.7, 0.1, 0.4}, blue{0.1, 0.2, 0.9, 0.5},
    yellow{0.9, 0.8, 0.1, 0.25};

TEST(Transparent, shows_what_lies_behind_in_the_share_that_it_does_not_cover) {
  const Color both = middle(panes({{0, red}, {1, green}}));
  expect_near(both, over(lit(green), stored(0.4f), lit(red)), "green over red");
  EXPECT_EQ(middle(panes({{1, red}, {0, green}})), lit(red)) << "what is opaque hides it";
}

TEST(Transparent, layers_cover_each_other_in_the_order_of_their_depth_not_of_the_file) {
  const Color expected = over(lit(yellow), stored(0.25f),
                              over(lit(blue), stored(0.5f), over(lit(green), stored(0.4f), lit(red))));
  for (const auto& order : {std::array{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}}) {
    const std::array<Pane, 4> all = {{{0, red}, {1, green}, {2, blue}, {3, yellow}}};
    std::vector<Pane> shuffled;
    for (const int i : order) shuffled.push_back(all[static_cast<size_t>(i)]);
    expect_near(middle(panes(shuffled)), expected, "four layers");
  }
}

TEST(Transparent, lets_the_background_shine_through) {
  const Color background = {background_bytes[0], background_bytes[1], background_bytes[2]};
  expect_near(middle(panes({{0, blue}})), over(lit(blue), stored(0.5f), background), "blue over nothing");
}

TEST(Transparent, is_opaque_where_the_effect_is_switched_off) {
  FrameState state;
  state.effects = Effects::none();
  EXPECT_EQ(middle(panes({{0, red}, {1, green}}), state), lit(green));
}

TEST(Transparent, is_seen_with_several_samples_and_behind_edges_too) {
  const Color expected = over(lit(green), stored(0.4f), lit(red));
  for (const uint32_t samples : {1u, 4u, 16u}) {
    for (const bool edges : {false, true}) {
      FrameState state;
      state.samples = samples;
      state.edges = edges;
      expect_near(middle(panes({{0, red}, {1, green}}), state), expected, "samples and edges");
    }
  }
}

TEST(Transparent, that_lies_flush_on_something_opaque_tints_it) {
  const Color tinted = middle(panes({{0, red}, {0, green}}));
  expect_near(tinted, over(lit(green), stored(0.4f), lit(red)), "flush");
}

/// In packs of one pane a drawable.
std::unique_ptr<Pack> pack_of_leaves(const Model& model, uint32_t triangles) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / ("triptych_glass_" + std::to_string(::getpid()) + ".tpk");
  build_pack(model, {.part_triangles = triangles, .leaf_triangles = triangles, .hlod_triangles = triangles},
             file);
  auto pack = std::make_unique<Pack>(file);
  std::filesystem::remove(file);
  return pack;
}

TEST(Transparent, owns_what_shows_of_it_and_nothing_else) {
  const std::vector<Pane> all = {{0, red}, {1, green}, {2, yellow}, {-1, blue}};
  const auto pack = pack_of_leaves(panes(all), 2);
  LocalPipeline pipeline(*pack, {.width = side,
                                 .height = side,
                                 .cull = StrategyKind::frustum,
                                 .device = test::device(),
                                 .item_buffer = true});
  const FrameRecord& record = pipeline.draw({0, {from_above(), 0}});
  ASSERT_EQ(record.visible.size(), all.size()) << "each is a drawable";
  const Skeleton& skeleton = pack->skeleton();
  const auto heights = [&](const VisibleSet& drawables) {
    std::vector<double> found;
    for (const DrawableId id : drawables) {
      const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[id].scene_node];
      found.push_back(std::round(skeleton.lattice().box(node.box).hi.z));
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  EXPECT_EQ(heights(pipeline.target().transparent_owners()), (std::vector<double>{1, 2}))
      << "not what lies behind something opaque";
  EXPECT_EQ(heights(owners(pipeline.target(), 1)), (std::vector<double>{0, 1, 2}));
}

/// A model of one pane is one drawable, so that sets say what is hidden.
TEST(Transparent, hides_nothing_from_the_strategy) {
  for (const bool is_glass : {false, true}) {
    std::vector<Mesh> meshes = {awkward::box({-3, -3, 4}, {3, 3, 4.1}, 0)};
    for (int i = 0; i < 30; ++i) {
      const double x = -1.5 + 0.1 * i;
      meshes.push_back(awkward::box({x, -0.5, 0}, {x + 0.08, 0.5, 1}, 1));
    }
    Model model = awkward::model_of(std::move(meshes));
    model.materials = {{.base_color = {0.5, 0.5, 0.9, is_glass ? 0.3 : 1}}, {.base_color = red}};
    const auto pack = pack_of_leaves(model, 12);
    LocalPipeline pipeline(*pack, {.width = side, .height = side, .device = test::device()});
    for (uint32_t i = 0; i < 3; ++i) pipeline.draw({i, {from_above(), 0}});
    const FrameRecord& last = pipeline.draw({3, {from_above(), 0}});
    if (is_glass) {
      EXPECT_GT(last.visible_count, 20u);
    } else {
      EXPECT_LT(last.visible_count, 5u);
    }
    EXPECT_EQ(last.effects.size(), is_glass ? 1u : 0u) << "a pass runs only where something calls for it";
  }
}

TEST(Transparent, lists_that_are_made_in_parts_make_the_same_picture) {
  const Pack& pack = scenes::pack("glass");
  constexpr int width = 96, height = 64;
  const Hierarchy hierarchy(pack.skeleton());
  LevelsRepresentation levels(hierarchy);
  const auto pictures = [&](size_t max_fragments, uint64_t& splits) {
    LoadOnDemand residency(pack);
    const auto device =
        make_raster_device(pack.skeleton(), levels, residency, {.max_fragments = max_fragments});
    const auto target = device->make_target(TargetKind::color, width, height);
    std::vector<std::vector<uint8_t>> all;
    for (const View& view : scenes::random_views(pack.skeleton(), width, height, 12, 5)) {
      const FrameView frame(pack.skeleton(), {view, 1, 4});
      target->begin(frame);
      target->draw(select_cut(frame).drawables);
      target->finish();
      all.push_back(target->read_colors());
      for (const EffectUse& use : target->effects()) splits += use.splits;
    }
    return all;
  };
  uint64_t none = 0, many = 0;
  EXPECT_EQ(pictures(size_t{1} << 20, none), pictures(50, many));
  EXPECT_EQ(none, 0u);
  EXPECT_GT(many, 100u);
}

TEST(Transparent, lists_of_opengl_that_are_made_in_parts_make_the_same_picture) {
  if (!test::on_gl()) GTEST_SKIP() << "the rasteriser has lists of its own";
  const Pack& pack = scenes::pack("glass");
  constexpr int width = 96, height = 64;
  const Hierarchy hierarchy(pack.skeleton());
  LevelsRepresentation levels(hierarchy);
  LoadOnDemand residency(pack);
  Renderer renderer(pack.skeleton(), levels, residency);
  ResolvePass resolve;
  const Framebuffer planes(TargetKind::color, width, height), picture(TargetKind::color, width, height);
  FragmentLists whole, small(24 * 60);  // bytes of a fragment
  uint64_t splits = 0, fragments = 0;
  for (const View& view : scenes::random_views(pack.skeleton(), width, height, 12, 5)) {
    const FrameView frame(pack.skeleton(), {view, 1});
    std::vector<DrawableId> cut = select_cut(frame).drawables, transparent;
    sort_by_rank(pack.skeleton(), frame.cell, cut);
    renderer.set_view(frame);
    planes.clear();
    renderer.draw(cut, planes, transparent);
    const auto picture_with = [&](FragmentLists& lists) {
      VisibleSet found;
      renderer.draw_transparent(transparent, planes, lists, &found);
      resolve.draw(frame, planes, &lists.veils(), picture);
      std::sort(found.begin(), found.end());
      return std::pair(picture.read_colors(), found);
    };
    const auto expected = picture_with(whole);
    EXPECT_EQ(picture_with(small), expected);
    EXPECT_EQ(whole.splits(), 0u);
    EXPECT_EQ(small.fragments(), whole.fragments());
    splits += small.splits();
    fragments += whole.fragments();
  }
  EXPECT_GT(splits, 100u);
  EXPECT_GT(fragments, 10'000u);
}

TEST(TransparentSurfaces, are_not_outward_nor_is_what_is_seen_through_them) {
  Chunk chunk;
  const Mesh box = awkward::box({0, 0, 0}, {8, 8, 8});
  for (const glm::dvec3& position : box.positions) chunk.vertices.push_back({glm::ivec3(position)});
  for (const Triangle& triangle : box.triangles)
    chunk.indices.insert(chunk.indices.end(), triangle.vertices.begin(), triangle.vertices.end());
  const auto count = static_cast<uint32_t>(chunk.vertices.size());
  const std::vector<std::array<uint8_t, 4>> palette = {{9, 9, 9, 255}, {9, 9, 9, 80}};
  const auto decoded = [&] {
    std::vector<LatticeBox> whole = {chunk.box()};
    ChunkInfo info;
    const auto bytes = encode_chunk(chunk, {}, palette);
    info.size = bytes.size();
    info.vertex_count = static_cast<uint32_t>(chunk.vertices.size());
    info.triangle_count = static_cast<uint32_t>(chunk.triangle_count());
    info.box = chunk.box();
    return decode_chunk(bytes, info, whole, palette.size(), "chunk");
  };
  EXPECT_FALSE(decoded().outward_runs.empty()) << "all of it is opaque";
  // One triangle of glass, with corners of its own, in the middle of the list.
  for (uint32_t k = 0; k < 3; ++k) {
    ChunkVertex vertex = chunk.vertices[chunk.indices[3 * 5 + k]];
    vertex.color = 1;
    chunk.indices[3 * 5 + k] = count + k;
    chunk.vertices.push_back(vertex);
  }
  const Chunk again = decoded();
  EXPECT_TRUE(again.outward_runs.empty());
  EXPECT_EQ(transparent_runs(again, palette), (std::vector<uint32_t>{11, 12})) << "it comes last";
}

}  // namespace
}  // namespace triptych
