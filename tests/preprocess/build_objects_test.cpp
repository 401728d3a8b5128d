// Builds of models whose files name what is in them: scene nodes, placements and triangles know their source
// objects.
#include "base/file.hpp"
#include "model/flatten.hpp"
#include "preprocess/build.hpp"
#include "preprocess/triangle_objects.hpp"
#include "scene/pack.hpp"
#include "scene/pack_objects.hpp"
#include "tests/support/awkward_meshes.hpp"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace triptych {
namespace {

const BuildOptions small_leaves{.part_triangles = 300, .leaf_triangles = 900, .hlod_triangles = 300};

/// The running test's own: others may run beside it.
std::filesystem::path file_of(const std::string& name) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  return std::filesystem::path(testing::TempDir()) / ("triptych_objects_" + test + "_" + name + ".tpk");
}

Pack built(const Model& model, const std::string& name, const BuildOptions& options = small_leaves) {
  build_pack(model, options, file_of(name));
  return Pack(file_of(name));
}

/// `count` objects called by their numbers.
SourceObjects numbered(uint32_t count) {
  SourceObjects source;
  for (uint32_t i = 0; i < count; ++i)
    source.objects.push_back({.name = source.texts.add(std::to_string(i))});
  return source;
}

/// Bumpy plates and spheres of an object each, in rows, none of which touch; the last one belongs to none.
Model rows() {
  Model model = awkward::model_of({awkward::sphere(12, 0.4), awkward::grid(20, 0.8, 0.1)});
  model.instances.clear();
  for (uint32_t i = 0; i < 64; ++i) {
    model.instances.push_back({i % 2, awkward::translation({i % 8 * 1.0, i / 8 * 1.0, 0}), i});
  }
  model.instances.push_back({0, awkward::translation({20, 0, 0})});
  model.source_objects = numbered(64);
  return model;
}

double distance_to(const Box& box, const glm::dvec3& point) {
  return glm::length(glm::max(glm::max(box.lo - point, point - box.hi), glm::dvec3(0)));
}

/// Every triangle of every level has a corner at the object that it names, as far as the level's bound
/// allows: a coarse one stands for several.
void expect_triangles_at_their_objects(const Pack& pack, const std::vector<Box>& boxes) {
  const PackObjects objects = pack.read_objects();
  const Skeleton& skeleton = pack.skeleton();
  uint64_t inner = 0, none = 0;
  for (DrawableId id = 0; id < skeleton.drawables.size(); ++id) {
    const Drawable& drawable = skeleton.drawables[id];
    for (uint32_t i = 0; i < drawable.placement_count; ++i) {
      const Placement& placement = skeleton.placements[drawable.first_placement + i];
      const Chunk chunk = pack.read_chunk(placement.chunk);
      const Lattice& lattice = skeleton.lattices[skeleton.chunks[placement.chunk].lattice];
      for (uint32_t k = 0; k < chunk.triangle_count(); ++k) {
        const SourceObjectId object = objects.object_at(id, i, k);
        none += object == no_id;
        if (object == no_id) continue;
        ASSERT_LT(object, boxes.size());
        double nearest = std::numeric_limits<double>::infinity();
        for (size_t corner = 0; corner < 3; ++corner) {
          const glm::dvec3 at =
              skeleton.transforms[placement.transform] *
              glm::dvec4(lattice.position(chunk.vertices[chunk.indices[3 * k + corner]].point), 1);
          nearest = std::min(nearest, distance_to(boxes[object], at));
        }
        EXPECT_LE(nearest, drawable.error / 2 + 1e-3) << "drawable " << id;
        inner += skeleton.scene_nodes[drawable.scene_node].child_count > 0;
      }
    }
  }
  EXPECT_GT(inner, 100u);
  EXPECT_GT(none, 100u);
}

TEST(BuildObjects, every_triangle_of_every_level_names_its_object) {
  const Model model = rows();
  std::vector<Box> boxes;
  for (uint32_t i = 0; i < 64; ++i) {
    const glm::dvec3 at = model.instances[i].transform[3];
    boxes.push_back(i % 2 == 0 ? Box{at - 0.4, at + 0.4}
                               : Box{at + glm::dvec3(0, 0, -0.1), at + glm::dvec3(0.8, 0.8, 0.1)});
  }
  const Pack pack = built(model, "rows");
  ASSERT_GT(pack.skeleton().scene_nodes.size(), 10u);
  expect_triangles_at_their_objects(pack, boxes);
  const PackObjects objects = pack.read_objects();
  for (SourceObjectId id = 0; id < 64; ++id) {
    ASSERT_GE(objects.nodes_of(id).size(), 1u) << id;
    for (const SceneNodeId node : objects.nodes_of(id)) {
      const Box box = pack.skeleton().lattice().box(pack.skeleton().scene_nodes[node].box);
      EXPECT_TRUE(box.contains(Box{center(boxes[id]), center(boxes[id])})) << id;
    }
  }
  EXPECT_EQ(objects.objects_below(0).size(), 64u);
}

TEST(BuildObjects, names_change_nothing_that_is_drawn_and_threads_nothing_at_all) {
  Model named = rows(), nameless = rows();
  nameless.source_objects = {};
  const Pack with = built(named, "named"), without = built(nameless, "nameless");
  EXPECT_EQ(with.content_hash(), without.content_hash());
  EXPECT_TRUE(without.read_objects().source().empty());
  const std::string once = read_text_file(file_of("named"));
  built(named, "named");
  EXPECT_EQ(read_text_file(file_of("named")), once);
}

/// Three rows of a sphere and a plate each, as a group with objects of its own in each place.
Model grouped_rows() {
  Model model = awkward::model_of({awkward::sphere(12, 0.4), awkward::grid(20, 0.8, 0.1)});
  model.instances.clear();
  Group pair;
  for (uint32_t i = 0; i < 8; ++i)
    pair.instances.push_back({i % 2, awkward::translation({i * 1.0, 0, 0}), i});
  model.groups.push_back(pair);
  Group two;
  two.groups = {{0, awkward::translation({0, 0, 0}), 0}, {0, awkward::translation({0, 2, 0}), 8}};
  model.groups.push_back(two);
  for (uint32_t i = 0; i < 3; ++i)
    model.group_instances.push_back({1, awkward::translation({0, 5.0 * i, 1.0 * i}), i * 16});
  model.group_instances.push_back({0, awkward::translation({20, 0, 0})});  // without objects
  model.source_objects = numbered(48);
  return model;
}

TEST(BuildObjects, each_place_of_a_group_keeps_its_own_objects) {
  const Model model = grouped_rows();
  std::vector<Box> boxes(48);
  for (const Instance& instance : flattened(model).instances) {
    if (instance.object == no_id) continue;
    const glm::dvec3 at = instance.transform[3];
    boxes[instance.object] = instance.mesh == 0
                                 ? Box{at - 0.4, at + 0.4}
                                 : Box{at + glm::dvec3(0, 0, -0.1), at + glm::dvec3(0.8, 0.8, 0.1)};
  }
  const Pack pack = built(model, "groups");
  ASSERT_GT(pack.skeleton().instances.size(), 3u);
  expect_triangles_at_their_objects(pack, boxes);
  EXPECT_EQ(pack.read_objects().objects_below(0).size(), 48u);
  BuildOptions flat = small_leaves;
  flat.share_instances = false;
  expect_triangles_at_their_objects(built(model, "flat", flat), boxes);
}

TEST(TriangleObjects, a_triangle_takes_the_object_of_most_of_its_corners_then_of_most_area) {
  Baked geometry;
  geometry.surface.points = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 2}, {30, 0, 0}, {0, 30, 0}};
  geometry.surface.triangles = {{{0, 1, 2}, 0}, {{0, 3, 1}, 0}, {{0, 4, 5}, 0}};
  geometry.objects = {7, 8, 9};
  const TriangleObjects objects(geometry);
  Piece level{{geometry.surface.points, {}, {}}, {0, 1, 2, 3, 4, 5}};
  level.surface.triangles = {{{0, 1, 3}, 0}, {{0, 1, 5}, 0}, {{0, 4, 1}, 0}};
  // 8 at three corners; 7 and 8 at two, 9 at two with more area; 9 at two and 7, 8 at two again.
  EXPECT_EQ(objects.of(level), (std::vector<SourceObjectId>{8, 9, 9}));
  EXPECT_TRUE(TriangleObjects(Baked{geometry.surface, {}, 0, {}}).of(level).empty());
}

}  // namespace
}  // namespace triptych
