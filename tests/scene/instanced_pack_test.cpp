// Packs with sub-hierarchies: what is read, and whatever can be wrong with the section SUBH.
#include "tests/support/instanced_pack.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/hashing.hpp"
#include "preprocess/check/check.hpp"
#include "scene/expand.hpp"
#include "scene/pack.hpp"
#include "scene/pack_skeleton.hpp"
#include "tests/support/pack_bytes.hpp"

namespace triptych {
namespace {

using namespace test;

TEST(InstancedPack, is_read_back_expanded) {
  const InstancedPack written = instanced_pack();
  const Pack pack(write_pack(written));
  EXPECT_EQ(pack.format_version(), instanced_pack_format_version);
  EXPECT_EQ(pack.skeleton().scene_nodes.size(), 25u);
  EXPECT_EQ(pack.skeleton().drawables.size(), 26u);
  EXPECT_EQ(pack.skeleton().instances.size(), 7u);
  EXPECT_EQ(pack.skeleton().sub_hierarchies, 2u);
  EXPECT_EQ(pack.skeleton().chunks.size(), 3u);
  for (uint32_t i = 0; i < 3; ++i) EXPECT_EQ(pack.read_chunk(i).box(), written.chunks[i].box());
}

TEST(InstancedPack, made_by_hand_is_sound) {
  const CheckReport report = check_pack(Pack(write_pack(instanced_pack())), {.points = 200'000});
  EXPECT_TRUE(report.sound()) << (report.messages.empty() ? "" : report.messages[0]);
  EXPECT_EQ(report.drawables_not_checked, 0u);
}

TEST(InstancedPack, one_without_instances_is_a_pack_as_before_to_the_byte) {
  const std::string before = read_text_file(write_pack(small_pack()));
  const SmallPack small = small_pack();
  StoredSkeleton stored = instanced_pack().skeleton;
  stored.instances.clear();
  stored.surrounding = small.skeleton;
  EXPECT_EQ(read_text_file(write_pack(small.chunks, small.chunk_lattices, stored)), before);
  EXPECT_EQ(value_at<uint32_t>(before, 8), pack_format_version);
}

TEST(InstancedPack, the_content_hash_covers_sub_hierarchies) {
  InstancedPack pack = instanced_pack();
  const uint64_t hash = Pack(write_pack(pack)).content_hash();
  EXPECT_EQ(Pack(write_pack(pack)).content_hash(), hash);
  pack.skeleton.sub_hierarchies[1].instances[1].stretch = 1.5;
  EXPECT_NE(Pack(write_pack(pack)).content_hash(), hash);
}

TEST(InstancedPack, a_file_cut_anywhere_is_refused) {
  const auto file = write_pack(instanced_pack());
  const std::string whole = read_text_file(file);
  for (size_t length = 0; length < whole.size(); length += whole.size() - length < 110 ? 1 : 7)
    EXPECT_NE(error_of(file, whole.substr(0, length)), "") << length;
}

TEST(InstancedPack, a_flipped_byte_anywhere_is_refused_and_said_where) {
  const auto file = write_pack(instanced_pack());
  const std::string whole = read_text_file(file);
  const auto table = value_at<uint64_t>(whole, 16);
  const auto sub_hierarchies = value_at<uint64_t>(whole, table + 2 * section_bytes + 8);
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    const std::string error = error_of(file, damaged);
    ASSERT_NE(error, "") << "byte " << i;
    if (i < sub_hierarchies) continue;  // the rest is as in packs without sub-hierarchies
    EXPECT_NE(error.find(i < table ? "section SUBH" : "section table"), std::string::npos) << i << error;
  }
}

TEST(InstancedPack, versions_and_sections_that_do_not_go_together_are_refused) {
  const auto file = write_pack(instanced_pack());
  const std::string whole = read_text_file(file);
  const auto table = value_at<uint64_t>(whole, 16);
  std::string changed = whole;
  put(changed, table + 2 * section_bytes, std::array{'X', 'T', 'R', 'A'});
  seal_table(changed);
  EXPECT_NE(error_of(file, changed).find("names no SUBH section"), std::string::npos);
  changed = whole;
  put(changed, 8, pack_format_version);
  seal_table(changed);
  EXPECT_NE(error_of(file, changed).find("names a SUBH section"), std::string::npos);
  changed = whole;
  put(changed, table + 2 * section_bytes + 4, uint32_t{2});
  seal_table(changed);
  EXPECT_NE(error_of(file, changed).find("newer version"), std::string::npos);
  changed = whole;
  changed.insert(table, whole.substr(table + 2 * section_bytes, section_bytes));
  put(changed, 12, uint32_t{4});
  seal_table(changed);
  EXPECT_NE(error_of(file, changed).find("two SUBH sections"), std::string::npos);
}

TEST(InstancedPack, sub_hierarchies_that_do_not_hold_together_are_refused) {
  const auto refused = [](auto&& change) {
    InstancedPack pack = instanced_pack();
    change(pack.skeleton);
    try {
      const Pack opened(write_pack(pack));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("section S"), std::string::npos) << error.what();
      return;
    }
    ADD_FAILURE() << "was opened";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](StoredSkeleton& s) { s.instances[0].scene_node = 4; });
  refused([](StoredSkeleton& s) { s.instances[0].scene_node = 0; });
  refused([](StoredSkeleton& s) { s.instances[1].scene_node = 1; });
  refused([](StoredSkeleton& s) { std::swap(s.instances[0], s.instances[1]); });
  refused([](StoredSkeleton& s) { s.instances.pop_back(); });  // a leaf without a drawable
  refused([](StoredSkeleton& s) { s.instances[0].sub_hierarchy = 2; });
  refused([](StoredSkeleton& s) { s.instances[0].transform = 7; });
  refused([](StoredSkeleton& s) { s.instances[0].stretch = -1; });
  refused([&](StoredSkeleton& s) { s.instances[0].stretch = nan; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[1].instances[0].sub_hierarchy = 1; });  // itself
  refused(
      [](StoredSkeleton& s) { s.sub_hierarchies[0].instances = {{.scene_node = 1, .sub_hierarchy = 1}}; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[1].lattice = 3; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[1].transforms.clear(); });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[1].transforms[0][3].x = 1; });
  refused([&](StoredSkeleton& s) { s.sub_hierarchies[1].transforms[1][3].x = nan; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].scene_nodes.clear(); });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].scene_nodes[0].parent = 1; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].scene_nodes[2].drawable_count = 0; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].scene_nodes[2].box.hi.x = 0; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].drawables[0].error = -1; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].placements[0].chunk = 3; });
  refused([](StoredSkeleton& s) { s.sub_hierarchies[0].placements[0].transform = 3; });
}

TEST(InstancedPack, sections_cut_anywhere_or_changed_anywhere_never_crash) {
  StoredSkeleton stored = instanced_pack().skeleton;
  stored.surrounding.chunks.assign(3, ChunkInfo{.size = 10, .box = {{0, 0, 0}, {1, 1, 1}}});
  stored.surrounding.drawables[0].triangles = 0;
  for (Drawable& drawable : stored.sub_hierarchies[0].drawables) drawable.triangles = 0;
  const auto skeleton = encode_skeleton(stored.surrounding);
  const auto bytes = encode_sub_hierarchies(stored);
  const auto open = [&](std::span<const std::byte> first, std::span<const std::byte> second) {
    return expand(decode_skeleton({first, "SKEL"}, {second, "SUBH"}, 100), "SUBH", 1 << 20);
  };
  EXPECT_EQ(open(skeleton, bytes).scene_nodes.size(), 25u);
  for (size_t length = 0; length < bytes.size(); ++length)
    EXPECT_THROW(open(skeleton, std::span(bytes).first(length)), Error);
  const auto changed = [](std::vector<std::byte> damaged, size_t bit) {
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    return damaged;
  };
  const auto try_open = [&](std::span<const std::byte> first, std::span<const std::byte> second) {
    try {
      const Skeleton opened = open(first, second);
      for (size_t i = 1; i < opened.scene_nodes.size(); ++i) {
        const SceneNode& node = opened.scene_nodes[i];
        ASSERT_LT(node.parent, i);
        ASSERT_FALSE(node.box.empty());
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_GE(node.box.lo[axis], -Lattice::limit);
          ASSERT_LE(node.box.hi[axis], Lattice::limit);
        }
      }
    } catch (const Error&) {
    }
  };
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) try_open(skeleton, changed(bytes, bit));
  for (size_t bit = 0; bit < 8 * skeleton.size(); ++bit) try_open(changed(skeleton, bit), bytes);
}

}  // namespace
}  // namespace triptych
