// The section OBJS: what is written is read, by whom it is asked for, and damage is one error.
#include "scene/pack_objects.hpp"

#include "preprocess/encode_objects.hpp"
#include "preprocess/triangle_objects.hpp"
#include "tests/support/instanced_pack.hpp"
#include "tests/support/pack_bytes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace test;

/// A wall and a roof with a property set each shares, in a hall; texts in no order.
SourceObjects some_objects() {
  SourceObjects source;
  const auto text = [&](const char* letters) { return source.texts.add(letters); };
  source.objects = {{.name = text("Hall")},
                    {.name = text("Wall 2"),
                     .type = text("IfcWall"),
                     .guid = text("2ABc"),
                     .layer = text("A-WALL"),
                     .storey = text("Ground floor"),
                     .number = text("#12"),
                     .parent = 0},
                    {.name = text("Roof"), .type = text("IfcSlab"), .parent = 0, .first_set = 1}};
  source.set_uses = {0, 1, 0};
  source.sets = {{.name = text("Pset_Common")}, {.name = text("Costs"), .first_property = 2}};
  source.properties = {
      {text("FireRating"), text("F90")}, {text("Empty"), 0}, {text("Euro"), text("a \xc3\xa9 b")}};
  return source;
}

/// Of small_pack(): leaf 1 belongs to the wall, leaf 2 to the roof, the root's two squares to both.
StoredObjects stored_objects() {
  StoredObjects stored{some_objects(), {}};
  HierarchyObjects& hierarchy = stored.hierarchies.emplace_back();
  hierarchy.add_leaf(1, std::vector<ObjectRun>{{1, 1}});
  hierarchy.add_leaf(2, std::vector<ObjectRun>{{1, 2}});
  return stored;
}

std::filesystem::path write_pack_with(const SmallPack& pack, std::span<const std::byte> section) {
  const auto file = write_pack(pack);
  PackWriter writer(file);
  for (size_t i = 0; i < pack.chunks.size(); ++i) writer.add_chunk(pack.chunks[i], pack.chunk_lattices[i]);
  writer.finish({pack.skeleton, {}, {}}, section);
  return file;
}

std::string objects_error_of(const std::filesystem::path& file) {
  try {
    Pack(file).read_objects();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string text(const PackObjects& objects, uint32_t number) {
  return std::string(objects.source().texts[number]);
}

TEST(PackObjects, what_is_written_is_read_back) {
  const Pack pack(write_pack_with(small_pack(), encode_objects(stored_objects())));
  const PackObjects objects = pack.read_objects();
  const SourceObjects& source = objects.source();
  ASSERT_EQ(source.objects.size(), 3u);
  const SourceObject& wall = source.objects[1];
  EXPECT_EQ(text(objects, wall.name), "Wall 2");
  EXPECT_EQ(text(objects, wall.type), "IfcWall");
  EXPECT_EQ(text(objects, wall.guid), "2ABc");
  EXPECT_EQ(text(objects, wall.layer), "A-WALL");
  EXPECT_EQ(text(objects, wall.storey), "Ground floor");
  EXPECT_EQ(text(objects, wall.number), "#12");
  EXPECT_EQ(text(objects, source.objects[2].guid), "");
  EXPECT_EQ(source.path_of(1), "Hall");
  EXPECT_EQ(source.path_of(0), "");
  EXPECT_TRUE(source.sets_of(0).empty() && source.sets_of(1).size() == 1);
  ASSERT_EQ(source.sets_of(2).size(), 2u);
  const auto costs = source.properties_of(source.sets_of(2)[0]);
  ASSERT_EQ(costs.size(), 1u);
  EXPECT_EQ(text(objects, costs[0].value), "a \xc3\xa9 b");
  EXPECT_EQ(source.properties_of(source.sets_of(2)[1]).size(), 2u);
  ASSERT_EQ(objects.nodes_of(1).size(), 1u);
  EXPECT_EQ(objects.nodes_of(1)[0], 1u);
  EXPECT_TRUE(objects.nodes_of(0).empty());
  EXPECT_EQ(objects.objects_below(0), (std::vector<SourceObjectId>{1, 2}));
  EXPECT_EQ(objects.object_at(3, 0, 5), 2u);
}

TEST(PackObjects, a_pack_without_objects_has_no_section_and_the_same_bytes) {
  const std::string with = read_text_file(write_pack_with(small_pack(), encode_objects(stored_objects())));
  const std::string without = read_text_file(write_pack_with(small_pack(), {}));
  EXPECT_EQ(without, read_text_file(write_pack(small_pack())));
  EXPECT_EQ(value_at<uint32_t>(without, 12), 2u);
  EXPECT_EQ(value_at<uint32_t>(with, 12), 3u);
  const Pack pack(write_pack_with(small_pack(), {}));
  EXPECT_TRUE(pack.read_objects().source().empty());
  EXPECT_TRUE(pack.read_objects().objects_below(0).empty());
  EXPECT_EQ(pack.content_hash(),
            Pack(write_pack_with(small_pack(), encode_objects(stored_objects()))).content_hash());
}

TEST(PackObjects, damage_of_the_section_is_said_when_it_is_asked_for_and_not_before) {
  const auto file = write_pack_with(small_pack(), encode_objects(stored_objects()));
  const std::string whole = read_text_file(file);
  const auto entry = value_at<uint64_t>(whole, 16) + 2 * section_bytes;
  const auto begin = value_at<uint64_t>(whole, entry + 8), size = value_at<uint64_t>(whole, entry + 16);
  for (uint64_t i = begin; i < begin + size; i += 5) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    EXPECT_EQ(error_of(file, damaged), "") << "opening the pack read byte " << i;
    const std::string error = objects_error_of(file.string() + ".damaged");
    EXPECT_NE(error.find("section OBJS: byte " + std::to_string(begin) + ": the checksum"), std::string::npos)
        << error;
  }
  std::string newer = whole;
  put(newer, entry + 4, uint32_t{7});
  seal_table(newer);
  EXPECT_EQ(error_of(file, newer), "");
  EXPECT_NE(objects_error_of(file.string() + ".damaged").find("is of version 7"), std::string::npos);
}

TEST(PackObjects, bytes_that_are_sealed_and_wrong_are_refused) {
  const std::vector<std::byte> whole = encode_objects(stored_objects());
  for (size_t length = 0; length < whole.size(); ++length) {
    EXPECT_THROW(decode_objects(std::span(whole).first(length), "x"), Error) << length;
  }
  for (size_t i = 0; i < whole.size(); ++i) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::vector<std::byte> damaged = whole;
      damaged[i] ^= static_cast<std::byte>(flip);
      const Pack pack(write_pack(small_pack()));
      try {
        const PackObjects objects(decode_objects(damaged, "x"), pack.skeleton(), "x");
        for (const SourceObjectId object : objects.objects_below(0))
          ASSERT_LT(object, objects.source().objects.size());
      } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find("x: "), 0u) << error.what();
      }
    }
  }
}

TEST(PackObjects, a_section_that_does_not_fit_the_skeleton_is_refused) {
  const auto error = [](const auto& change) {
    StoredObjects stored = stored_objects();
    change(stored);
    return objects_error_of(write_pack_with(small_pack(), encode_objects(stored)));
  };
  EXPECT_EQ(error([](StoredObjects&) {}), "");
  const auto says = [&](const auto& change, const char* what) {
    const std::string message = error(change);
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_NE(message.find("section OBJS: "), std::string::npos) << message;
  };
  says([](StoredObjects& stored) { stored.hierarchies[0].leaves[1] = 3; }, "names scene node 3 of 3");
  says([](StoredObjects& stored) { stored.hierarchies[0].runs[0].object = 3; }, "names object 3 of 3");
  says([](StoredObjects& stored) { stored.hierarchies[0].runs[0].placements = 2; }, "says of 2 placements");
  says([](StoredObjects& stored) { stored.hierarchies.emplace_back(); }, "is of 2 hierarchies");
  says([](StoredObjects& stored) { stored.hierarchies[0].instances = {0}; }, "is of 1 instances");
  says([](StoredObjects& stored) { stored.objects.objects[1].parent = 2; }, "which comes later");
  says([](StoredObjects& stored) { stored.objects.set_uses[0] = 2; }, "names property set 2 of 2");
  const auto triangles = [](uint32_t count, SourceObjectId object) {
    return [=](StoredObjects& stored) {
      stored.hierarchies[0].add_drawable(0, encode_triangle_objects(std::vector(count, object)));
    };
  };
  EXPECT_EQ(error(triangles(4, 1)), "");
  says(triangles(4, 3), "names object 3 of 3");
  says(triangles(3, 1), "says of 3 triangles");
  says(triangles(5, 1), "says of more triangles");
}

TEST(PackObjects, triangles_of_an_inner_scene_node_have_an_object_each) {
  const std::vector<SourceObjectId> triangles = {2, 2, no_id, 1};
  StoredObjects stored = stored_objects();
  stored.hierarchies[0].add_drawable(0, encode_triangle_objects(triangles));
  const Pack pack(write_pack_with(small_pack(), encode_objects(stored)));
  const PackObjects objects = pack.read_objects();
  for (uint32_t i = 0; i < triangles.size(); ++i) EXPECT_EQ(objects.object_at(0, 0, i), triangles[i]);
}

TEST(PackObjects, each_place_of_a_sub_hierarchy_has_objects_of_its_own) {
  const InstancedPack instanced = instanced_pack();
  StoredObjects stored;
  for (int i = 0; i < 12; ++i)
    stored.objects.objects.push_back({.name = stored.objects.texts.add("object " + std::to_string(i))});
  stored.hierarchies.resize(3);
  stored.hierarchies[0].instances = {0, 4, 10};  // a pair, a pair, a single one
  stored.hierarchies[1].add_leaf(1, std::vector<ObjectRun>{{1, 0}});
  stored.hierarchies[1].add_leaf(2, std::vector<ObjectRun>{{1, 1}});
  stored.hierarchies[2].instances = {0, 2};
  const auto file = write_pack(instanced);
  PackWriter writer(file);
  for (size_t i = 0; i < instanced.chunks.size(); ++i)
    writer.add_chunk(instanced.chunks[i], instanced.chunk_lattices[i]);
  writer.finish(instanced.skeleton, encode_objects(stored));
  const Pack pack(file);
  const PackObjects objects = pack.read_objects();
  // Those in the single one are scene nodes 10 to 12; those in the pairs begin at 13, 16, 19 and 22.
  const std::vector<SceneNodeId> expected = {14, 15, 17, 18, 20, 21, 23, 24, 0, 0, 11, 12};
  for (SourceObjectId id = 0; id < expected.size(); ++id) {
    const auto nodes = objects.nodes_of(id);
    ASSERT_EQ(nodes.size(), expected[id] == 0 ? 0u : 1u) << id;
    if (!nodes.empty()) {
      EXPECT_EQ(nodes[0], expected[id]) << id;
    }
  }
  EXPECT_EQ(objects.objects_below(2), (std::vector<SourceObjectId>{4, 5, 6, 7}));
  stored.hierarchies[0].instances[2] = 11;
  EXPECT_THROW(PackObjects(stored, pack.skeleton(), "x"), Error);
}

}  // namespace
}  // namespace triptych
