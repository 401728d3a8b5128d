#include "preprocess/build.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/threads.hpp"
#include "scene/pack.hpp"
#include "scene/transforms.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/glm.hpp>
#include <gtest/gtest.h>
#include <map>

namespace triptych {
namespace {

std::filesystem::path file_of(const std::string& name) {
  return std::filesystem::path(testing::TempDir()) / (name + ".tpk");
}

/// Rooms with boxes, spheres that are placed many times, one mirrored, and one large surface.
Model small_building() {
  Model model = awkward::model_of({awkward::grid(40, 40, 2), awkward::sphere(10, 0.5), awkward::book(5)});
  model.instances.resize(1);
  for (int i = 0; i < 60; ++i) {
    Affine transform = awkward::translation({(i % 10) * 4.0, (i / 10) * 6.0, 3});
    if (i % 7 == 3) transform[0].x = -1;             // mirrored
    if (i % 5 == 1) transform[1] = {0.3, 1.7, 0.2};  // sheared and stretched
    model.instances.push_back({1u + (i % 3 == 0), transform});
  }
  for (int i = 0; i < 30; ++i) {
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    model.meshes.push_back(
        awkward::box({i, i % 4, 0}, {i + 0.8, i % 4 + 3, 2}, static_cast<uint32_t>(i % 3)));
  }
  return model;
}

BuildOptions small_parts() {
  BuildOptions options;
  options.part_triangles = 1000;
  options.leaf_triangles = 2000;
  options.hlod_triangles = 300;
  return options;
}

/// What every pack must be: boxes hold their vertices, errors never shrink, nothing is missing at the finest
/// level.
void expect_sound(const std::filesystem::path& file, uint64_t finest_triangles) {
  const Pack pack(file);
  const Skeleton& skeleton = pack.skeleton();
  uint64_t finest = 0;
  for (const SceneNode& node : skeleton.scene_nodes) {
    ASSERT_GT(node.drawable_count + node.child_count, 0u);
    double error = 0;
    uint32_t triangles = 0xffffffff;
    for (uint32_t i = node.first_drawable; i < node.first_drawable + node.drawable_count; ++i) {
      const Drawable& drawable = skeleton.drawables[i];
      EXPECT_GE(drawable.error, error);
      EXPECT_LT(drawable.triangles, triangles);
      error = drawable.error;
      triangles = drawable.triangles;
      uint32_t counted = 0;
      for (uint32_t k = drawable.first_placement; k < drawable.first_placement + drawable.placement_count;
           ++k) {
        const Placement& placement = skeleton.placements[k];
        const ChunkInfo& info = skeleton.chunks[placement.chunk];
        counted += info.triangle_count;
        const Box box = skeleton.lattice().box(node.box);
        for (const ChunkVertex& vertex : pack.read_chunk(placement.chunk).vertices) {
          const glm::dvec3 position = skeleton.transforms[placement.transform] *
                                      glm::dvec4(skeleton.lattices[info.lattice].position(vertex.point), 1);
          ASSERT_TRUE(box.contains(Box{position, position}));
        }
      }
      EXPECT_EQ(counted, drawable.triangles);
    }
    if (node.child_count == 0) finest += skeleton.drawables[node.first_drawable].triangles;
    for (uint32_t child = node.first_child; child < node.first_child + node.child_count; ++child) {
      EXPECT_TRUE(node.box.contains(skeleton.scene_nodes[child].box));
    }
  }
  EXPECT_EQ(finest, finest_triangles);
  std::vector<double> below(skeleton.scene_nodes.size(), 0);  // the largest error of what is drawn below
  for (size_t i = skeleton.scene_nodes.size(); i-- > 0;) {
    const SceneNode& node = skeleton.scene_nodes[i];
    double coarsest = below[i];
    if (node.drawable_count > 0) {
      EXPECT_GE(skeleton.drawables[node.first_drawable].error, below[i]);
      coarsest = skeleton.drawables[node.first_drawable + node.drawable_count - 1].error;
    }
    if (i > 0) below[node.parent] = std::max(below[node.parent], coarsest);
  }
}

using Edge = std::array<std::array<int, 3>, 2>;

/// Edges of the chunks of these drawables (all on the model's lattice), with the number of triangles at each.
std::map<Edge, int> edges_of(const Pack& pack, const std::vector<DrawableId>& drawables) {
  std::map<Edge, int> edges;
  for (const DrawableId id : drawables) {
    const Drawable& drawable = pack.skeleton().drawables[id];
    for (uint32_t k = drawable.first_placement; k < drawable.first_placement + drawable.placement_count;
         ++k) {
      const Chunk chunk = pack.read_chunk(pack.skeleton().placements[k].chunk);
      for (size_t i = 0; i < chunk.indices.size(); ++i) {
        const size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const glm::ivec3 a = chunk.vertices[chunk.indices[i]].point,
                         b = chunk.vertices[chunk.indices[next]].point;
        Edge edge = {{{a.x, a.y, a.z}, {b.x, b.y, b.z}}};
        std::sort(edge.begin(), edge.end());
        ++edges[edge];
      }
    }
  }
  return edges;
}

/// Where the surface below a node meets the rest, it stays as it is at every level of the node. Returns for
/// how many nodes it does.
size_t expect_borders_kept(const std::filesystem::path& file) {
  size_t with_border = 0;
  const Pack pack(file);
  const Skeleton& skeleton = pack.skeleton();
  for (SceneNodeId id = 0; id < skeleton.scene_nodes.size(); ++id) {
    // The border of what is below, at full detail: where it meets the rest of the sphere.
    std::vector<DrawableId> finest;
    std::vector<SceneNodeId> below = {id};
    for (size_t i = 0; i < below.size(); ++i) {
      const SceneNode& node = skeleton.scene_nodes[below[i]];
      if (node.child_count == 0) finest.push_back(node.first_drawable);
      for (uint32_t k = 0; k < node.child_count; ++k) below.push_back(node.first_child + k);
    }
    const auto source = edges_of(pack, finest);
    const SceneNode& node = skeleton.scene_nodes[id];
    for (DrawableId level = node.first_drawable; level < node.first_drawable + node.drawable_count; ++level) {
      const auto edges = edges_of(pack, {level});
      size_t border = 0, missing = 0;
      for (const auto& [edge, count] : source) {
        if (count != 1) continue;
        ++border;
        missing += !edges.contains(edge);
      }
      EXPECT_EQ(missing, 0u) << "node " << id << " drawable " << level;
      with_border += border > 0 && level == node.first_drawable;
    }
  }
  return with_border;
}

TEST(Build, a_small_building_makes_a_sound_pack) {
  const Model model = small_building();
  const auto file = file_of("small_building");
  const BuildReport report = build_pack(model, small_parts(), file);
  uint64_t placed = model.placed_triangles();
  placed -= 40u * 40u;  // the spheres' poles have no area: 40 triangles each of 40
  expect_sound(file, placed);
  EXPECT_EQ(report.placed_triangles, model.placed_triangles());
  EXPECT_EQ(report.source_triangles, model.source_triangles());
  EXPECT_EQ(report.pack_bytes, std::filesystem::file_size(file));
  EXPECT_EQ(report.import.dropped_triangles, 40u);
  EXPECT_GT(report.import.repaired_edges, 0u);  // the book's back
  const ObjectCounts counts = Pack(file).skeleton().objects;
  EXPECT_EQ(counts.initial, model.instances.size());
  EXPECT_GT(counts.partition1, counts.initial);
  EXPECT_LE(counts.clusters, counts.partition1);
  EXPECT_GE(counts.partition2, counts.clusters);
}

TEST(Build, one_and_two_threads_write_the_same_bytes) {
  const Model model = small_building();
  set_thread_count(1);
  build_pack(model, small_parts(), file_of("one_thread"));
  set_thread_count(2);
  build_pack(model, small_parts(), file_of("two_threads"));
  set_thread_count(0);
  EXPECT_EQ(read_file(file_of("one_thread")), read_file(file_of("two_threads")));
}

TEST(Build, a_mesh_that_goes_through_buckets_stays_closed_and_loses_nothing) {
  // The finest drawables hold the same triangles as those of a build in memory, and where the two share a
  // border, both keep it at every level.
  const Model model = awkward::model_of({awkward::sphere(40)});
  BuildOptions options = small_parts();
  build_pack(model, options, file_of("in_memory"));
  options.bucket_triangles = 700;
  build_pack(model, options, file_of("in_buckets"));
  std::array<std::map<Edge, int>, 2> finest;
  for (const bool buckets : {false, true}) {
    const Pack pack(file_of(buckets ? "in_buckets" : "in_memory"));
    std::vector<DrawableId> drawables;
    for (const SceneNode& node : pack.skeleton().scene_nodes) {
      if (node.child_count == 0) drawables.push_back(node.first_drawable);
    }
    finest[buckets] = edges_of(pack, drawables);
  }
  EXPECT_EQ(finest[0], finest[1]);
  expect_borders_kept(file_of("in_buckets"));
}

TEST(Build, baking_the_instances_draws_the_same_triangles) {
  const Model model = small_building();
  BuildOptions options = small_parts();
  build_pack(model, options, file_of("shared"));
  options.share_instances = false;
  const BuildReport baked = build_pack(model, options, file_of("baked"));
  expect_sound(file_of("baked"), model.placed_triangles() - 40u * 40u);
  EXPECT_EQ(Pack(file_of("baked")).skeleton().transforms.size(), 1u);
  EXPECT_EQ(baked.source_triangles, model.source_triangles());
}

TEST(Build, a_median_split_has_the_original_objects_as_leaves) {
  const Model model = small_building();
  BuildOptions options = small_parts();
  options.hierarchy = HierarchyKind::median_split;
  build_pack(model, options, file_of("median"));
  expect_sound(file_of("median"), model.placed_triangles() - 40u * 40u);
  const Pack pack(file_of("median"));
  size_t leaves = 0;
  for (const SceneNode& node : pack.skeleton().scene_nodes) {
    leaves += node.child_count == 0;
    EXPECT_TRUE(node.child_count == 0 || node.child_count == 2);
  }
  EXPECT_EQ(leaves, model.instances.size());
}

TEST(Build, a_single_triangle_makes_a_pack_of_one_drawable) {
  const Model model = awkward::model_of({{"one", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, 0}}}});
  build_pack(model, {}, file_of("single"));
  expect_sound(file_of("single"), 1);
  EXPECT_EQ(Pack(file_of("single")).skeleton().scene_nodes.size(), 1u);
}

TEST(Build, a_thousand_identical_boxes_at_one_place_are_all_there) {
  Model model = awkward::model_of({awkward::box({0, 0, 0}, {1, 1, 1})});
  model.instances.resize(1000, model.instances[0]);
  build_pack(model, small_parts(), file_of("thousand"));
  expect_sound(file_of("thousand"), 12000);
  EXPECT_LE(Pack(file_of("thousand")).skeleton().levels(), 8u);
}

TEST(Build, the_root_of_many_scattered_objects_has_few_triangles) {
  Model model = awkward::model_of({awkward::soup(1000)});
  for (int i = 0; i < 100; ++i) {
    model.instances.push_back({static_cast<uint32_t>(model.meshes.size()), Affine(1)});
    const glm::dvec3 lo{i * 7 % 31, i * 5 % 29, i * 3 % 23};
    model.meshes.push_back(awkward::box(lo, lo + 0.4));
  }
  BuildOptions options = small_parts();
  build_pack(model, options, file_of("scattered"));
  const Pack pack(file_of("scattered"));
  const SceneNode& root = pack.skeleton().scene_nodes[0];
  EXPECT_LE(pack.skeleton().drawables[root.first_drawable + root.drawable_count - 1].triangles,
            2 * options.hlod_triangles);
}

TEST(Build, the_borders_of_a_parted_surface_stay_as_they_are_at_every_level) {
  const Model model = awkward::model_of({awkward::sphere(40)});
  BuildOptions options = small_parts();
  options.part_triangles = 500;
  options.hlod_triangles = 32;  // all inner nodes have levels that are worth it
  build_pack(model, options, file_of("parted"));
  const size_t nodes = Pack(file_of("parted")).skeleton().scene_nodes.size();
  ASSERT_GT(nodes, 4u);
  EXPECT_EQ(expect_borders_kept(file_of("parted")), nodes - 1);  // all but the root
}

TEST(Build, borders_between_parts_cost_a_flat_plate_no_error_and_a_round_one_little) {
  BuildOptions options;
  options.part_triangles = options.leaf_triangles = 1000;
  build_pack(awkward::model_of({awkward::grid(120, 120)}), options, file_of("plate"));
  const Pack plate(file_of("plate"));
  EXPECT_GT(plate.skeleton().levels(), 3u);
  for (const Drawable& drawable : plate.skeleton().drawables) EXPECT_LT(drawable.error, 1e-5);
  build_pack(awkward::model_of({awkward::sphere(90, 10)}), options, file_of("round"));
  const Pack round(file_of("round"));
  EXPECT_GT(round.skeleton().levels(), 3u);
  const Drawable& root = round.skeleton().drawables[round.skeleton().scene_nodes[0].first_drawable];
  EXPECT_LT(root.triangles, 3000u);
  EXPECT_LT(root.error, 1.5);
}

TEST(Build, a_model_without_triangles_is_refused_and_leaves_no_file) {
  Model empty;
  empty.materials.emplace_back();
  EXPECT_THROW(build_pack(empty, {}, file_of("empty")), Error);
  Model flat = awkward::model_of({{"line", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{{0, 1, 2}, 0}}}});
  EXPECT_THROW(build_pack(flat, {}, file_of("empty")), Error);
  EXPECT_FALSE(std::filesystem::exists(file_of("empty")));
}

TEST(Build, a_model_too_small_to_be_measured_is_refused_and_one_too_large_left_out_and_counted) {
  const auto placed = [](double scale) {
    Model model = awkward::model_of({awkward::sphere(4)});
    model.instances[0].transform = Affine(glm::dmat4x3(scale, 0, 0, 0, scale, 0, 0, 0, scale, 0, 0, 0));
    return model;
  };
  EXPECT_NO_THROW(build_pack(placed(1e-38), {}, file_of("small")));
  EXPECT_NO_THROW(build_pack(placed(1e49), {}, file_of("large")));
  for (const double scale : {1e-41, 1e-200, 1e51, 1e200})
    EXPECT_THROW(build_pack(placed(scale), {}, file_of("beyond")), Error) << scale;
  EXPECT_FALSE(std::filesystem::exists(file_of("beyond")));
}

TEST(Build, singular_placements_are_pressed_flat_and_those_that_are_not_finite_left_out_and_counted) {
  Model model = awkward::model_of({awkward::box({0, 0, 0}, {1, 1, 1})});
  model.instances.resize(4, model.instances[0]);
  model.instances[1].transform[0] = {0, 0, 0};
  model.instances[2].transform[3].x = std::numeric_limits<double>::quiet_NaN();
  const BuildReport report = build_pack(model, {}, file_of("singular"));
  expect_sound(file_of("singular"), 12 + 12 + 4);  // flat: two sides are left, one upon the other
  ASSERT_EQ(report.import.warnings.size(), 1u);
  EXPECT_EQ(report.import.warnings[0].substr(0, 12), "1 placements");
}

TEST(Build, base_colours_become_srgb_bytes_once_each) {
  Model model = awkward::model_of({awkward::box({0, 0, 0}, {1, 1, 1}, 1)});
  model.materials = {Material{{0.5f, 0.5f, 0.5f, 1}}, Material{{1, 0, 0, 0.5f}},
                     Material{{0.5f, 0.5f, 0.5f, 1}}};
  build_pack(model, {}, file_of("colours"));
  const Pack pack(file_of("colours"));
  const auto& palette = pack.skeleton().palette;
  ASSERT_EQ(palette.size(), 2u);
  EXPECT_EQ(palette[0], (std::array<uint8_t, 4>{188, 188, 188, 255}));
  EXPECT_EQ(palette[1], (std::array<uint8_t, 4>{255, 0, 0, 128}));
}

TEST(Stretch, is_the_largest_singular_value) {
  EXPECT_NEAR(largest_stretch(Affine(1)), 1, 1e-9);
  Affine transform(1);
  transform[0] = {0, 3, 0};
  transform[1] = {-2, 0, 0};
  transform[2] = {0, 0, -0.5};
  EXPECT_NEAR(largest_stretch(transform), 3, 1e-9);
  Affine shear(1);
  shear[1] = {1, 1, 0};
  EXPECT_NEAR(largest_stretch(shear), (1 + std::sqrt(5.0)) / 2, 1e-9);
}

}  // namespace
}  // namespace triptych
