// Cut surfaces of closed surfaces: divided among chunks, hollow, in each other, inside out.
#include "preprocess/build.hpp"
#include "scene/solid_objects.hpp"
#include "tests/render/random_sections.hpp"
#include "tests/support/awkward_meshes.hpp"
#include "visibility/cap_look.hpp"

#include <algorithm>
#include <fmt/core.h>
#include <glm/gtc/constants.hpp>
#include <unistd.h>

namespace triptych {
namespace {

/// The mesh with its other side out.
Mesh turned(Mesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle.vertices[1], triangle.vertices[2]);
  return mesh;
}

/// Both as one mesh.
Mesh joined(Mesh mesh, const Mesh& other) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (Triangle triangle : other.triangles) {
    for (uint32_t& vertex : triangle.vertices) vertex += first;
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

/// Outward.
Mesh ball(uint32_t rings, double radius) { return awkward::sphere(rings, radius); }

Pack built(Model model, const BuildOptions& options) {
  const std::filesystem::path file =
      std::filesystem::path(testing::TempDir()) / fmt::format("triptych_cut_bodies_{}.tpk", getpid());
  build_pack(std::move(model), options, file);
  Pack pack(file);
  std::filesystem::remove(file);
  return pack;
}

/// What the pixels of a picture show of a section at z = 0 that is looked at along z: how many the cap of a
/// palette's colour, strokes or not, and how many anything.
struct Caps {
  size_t capped = 0, shown = 0;
};
Caps count_caps(LocalPipeline& pipeline, const Pack& pack, const FrameState& frame, size_t color = 0) {
  pipeline.draw({0, frame});
  const glm::ivec3 plain = lit(pack, color, {0, 0, 1}, frame, cap_tone);
  const auto& base = pack.skeleton().palette[color];
  const CapInk ink = cap_ink(glm::vec3(base[0], base[1], base[2]) / 255.0f);
  const glm::ivec3 inked(glm::round(glm::dvec3(plain) * double{ink.scale} + 255.0 * ink.add));
  const glm::ivec3 nothing(background_bytes[0], background_bytes[1], background_bytes[2]);
  const std::vector<uint8_t> colors = pipeline.target().read_colors();
  Caps caps;
  for (size_t at = 0; at < colors.size(); at += 4) {
    const glm::ivec3 pixel(colors[at], colors[at + 1], colors[at + 2]);
    caps.capped += alike(pixel, plain) || alike(pixel, inked);
    caps.shown += pixel != nothing;
  }
  return caps;
}

/// From so far along z, through an orthographic window that is 8 units high: 90 pixels.
FrameState along_z(double pixel_error = 1) {
  View view{.camera = {.eye = {0, 0, 20}, .target = {0, 0, 0}, .near = 0.1}, .width = 120, .height = 90};
  set_orthographic_height(view.camera, 8, 4.0 / 3);
  return {view, pixel_error};
}
constexpr double pixels_per_unit = 90.0 / 8;

TEST(CutBodies, that_were_divided_among_chunks_are_filled_as_a_whole) {
  const Pack pack = built(awkward::model_of({ball(24, 3)}), {.part_triangles = 64, .leaf_triangles = 64});
  const ClosedSurfaces& closed = pack.skeleton().closed;
  ASSERT_EQ(closed.bodies.size(), 1u);
  EXPECT_GT(closed.runs.size(), 20u);
  EXPECT_EQ(count_solids(pack).solid_placements, count_solids(pack).placements);
  LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
  for (const double pixel_error : {0.0, 1.0, 16.0}) {
    for (const bool slab : {false, true}) {  // its far side cuts away all that is behind the cap
      FrameState frame = along_z(pixel_error);
      if (slab) {
        frame.section.set_box({{-9, -9, -0.1}, {9, 9, 0}}, "test");
      } else {
        frame.section.add_plane({{0, 0, -1}, 0}, "test");
      }
      const Caps caps = count_caps(pipeline, pack, frame);
      const double disc = glm::pi<double>() * 9 * pixels_per_unit * pixels_per_unit;
      EXPECT_NEAR(static_cast<double>(caps.capped), disc, disc * 0.02) << pixel_error << slab;
      EXPECT_EQ(caps.capped, caps.shown);
    }
  }
}

TEST(CutBodies, with_a_cavity_show_their_walls_and_the_cavity_within) {
  const Mesh wall =
      joined(awkward::box({-3, -3, -3}, {3, 3, 3}), turned(awkward::box({-2, -2, -2}, {2, 2, 2})));
  for (const uint32_t part : {4096u, 8u}) {  // in one chunk, and divided
    const Pack pack = built(awkward::model_of({wall}), {.part_triangles = part, .leaf_triangles = part});
    EXPECT_EQ(pack.skeleton().closed.bodies.empty(), part > 8);
    EXPECT_EQ(count_solids(pack).solid_placements, count_solids(pack).placements);
    LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
    FrameState frame = along_z();
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    const Caps caps = count_caps(pipeline, pack, frame);
    const double unit = pixels_per_unit * pixels_per_unit;
    EXPECT_NEAR(static_cast<double>(caps.capped), (36 - 16) * unit, 80);
    EXPECT_NEAR(static_cast<double>(caps.shown), 36 * unit, 80);
  }
}

TEST(CutBodies, in_each_other_are_filled_once_and_rings_are_open_in_the_middle) {
  const double unit = pixels_per_unit * pixels_per_unit;
  {  // a ball in a ball, both outward: solid all the way
    const Pack pack = built(awkward::model_of({joined(ball(24, 3), ball(16, 1.5))}), {.part_triangles = 64});
    LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
    FrameState frame = along_z();
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    EXPECT_NEAR(static_cast<double>(count_caps(pipeline, pack, frame).capped), glm::pi<double>() * 9 * unit,
                60);
  }
  {  // cells around a hole, divided
    Mesh ring{"ring", {}, {}};
    for (const auto& [lo, hi] : {std::pair(glm::dvec3(-3, -3, -1), glm::dvec3(3, -2, 1)),
                                 {{-3, 2, -1}, {3, 3, 1}},
                                 {{-3, -2, -1}, {-2, 2, 1}},
                                 {{2, -2, -1}, {3, 2, 1}}})
      ring = joined(ring, awkward::box(lo, hi));
    const Pack pack = built(awkward::model_of({ring}), {.part_triangles = 8, .leaf_triangles = 8});
    LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
    FrameState frame = along_z();
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    const Caps caps = count_caps(pipeline, pack, frame);
    EXPECT_NEAR(static_cast<double>(caps.capped), 20 * unit, 80);
    EXPECT_EQ(caps.capped, caps.shown);
  }
}

TEST(CutBodies, that_are_inside_out_are_turned_round_with_their_cavities) {
  const Mesh hollow = joined(ball(24, 3), turned(ball(20, 2)));
  const double unit = pixels_per_unit * pixels_per_unit;
  for (const auto& [mesh, area] :
       {std::pair(turned(ball(24, 3)), 9.0), {turned(hollow), 5.0}, {hollow, 5.0}}) {
    const Pack pack = built(awkward::model_of({mesh}), {.part_triangles = 4096});
    LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
    FrameState frame = along_z();
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    EXPECT_NEAR(static_cast<double>(count_caps(pipeline, pack, frame).capped),
                area * glm::pi<double>() * unit, 60);
    const auto& warnings = pack.skeleton().import.warnings;
    EXPECT_EQ(
        std::ranges::any_of(
            warnings, [](const std::string& text) { return text.find("inside out") != std::string::npos; }),
        mesh.triangles != hollow.triangles);
  }
}

TEST(CutBodies, of_meshes_that_are_too_large_for_memory_are_found_as_well) {
  const BuildOptions options{.part_triangles = 64, .leaf_triangles = 64, .bucket_triangles = 300};
  for (const bool open : {false, true}) {
    Mesh mesh = joined(ball(24, 3), turned(ball(24, 2)));
    if (open) mesh.triangles.erase(mesh.triangles.begin() + 1000);
    const Pack pack = built(awkward::model_of({mesh}), options);
    EXPECT_EQ(pack.skeleton().closed.bodies.empty(), open);
    if (open) continue;
    LocalPipeline pipeline(pack, {.width = 120, .height = 90, .device = test::device()});
    FrameState frame = along_z();
    frame.section.add_plane({{0, 0, -1}, 0}, "test");
    const double wall = glm::pi<double>() * (9 - 4) * pixels_per_unit * pixels_per_unit;
    EXPECT_NEAR(static_cast<double>(count_caps(pipeline, pack, frame).capped), wall, 60);
  }
}

/// Divided balls, some hollow, some pierced by others, turned, stretched and mirrored.
Model divided_bodies() {
  const Mesh hollow = joined(ball(12, 3), turned(ball(10, 2)));
  Model model = awkward::model_of(
      {ball(12, 3), hollow, joined(hollow, awkward::box({-4, -0.5, -0.5}, {4, 0.5, 0.5}, 1))});
  model.instances.clear();
  scenes::Random random(5);
  for (uint32_t i = 0; i < 30; ++i) {
    Affine transform(1);
    for (int axis = 0; axis < 3; ++axis) transform[axis] *= random.number(0.6, 1.4);
    if (i % 4 == 3) transform[0] *= -1;
    if (i % 3 == 1) std::swap(transform[0], transform[2]);
    transform[3] = glm::dvec3(i % 5, i / 5 % 3, i / 15) * 5.0 + random.vector(-1, 1);
    model.instances.push_back({i % 3, transform});
  }
  return model;
}

TEST(CutBodies, under_random_sections_culled_pictures_equal_the_un_culled_ones) {
  const Pack pack = built(divided_bodies(), {.part_triangles = 40, .leaf_triangles = 60});
  ASSERT_GT(pack.skeleton().closed.bodies.size(), 3u);
  const auto [drawn, cut] = compare_under_sections(pack, test::on_gl() ? 40 : 480);
  EXPECT_LT(drawn, cut);
}

}  // namespace
}  // namespace triptych
