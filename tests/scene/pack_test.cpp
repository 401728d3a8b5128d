#include "scene/pack.hpp"

#include "base/bytes.hpp"
#include "base/error.hpp"
#include "base/hashing.hpp"
#include "preprocess/pack_writer.hpp"
#include "scene/effects.hpp"
#include "scene/pack_format.hpp"
#include "scene/pack_skeleton.hpp"
#include "tests/support/pack_bytes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace test;

TEST(Pack, what_is_written_is_read_back) {
  const SmallPack written = small_pack();
  const auto file = write_pack(written);
  const Pack pack(file);
  const Skeleton& skeleton = pack.skeleton();
  EXPECT_EQ(skeleton.scene_nodes, written.skeleton.scene_nodes);
  EXPECT_EQ(skeleton.drawables, written.skeleton.drawables);
  EXPECT_EQ(skeleton.placements, written.skeleton.placements);
  EXPECT_EQ(skeleton.transforms, written.skeleton.transforms);
  EXPECT_EQ(skeleton.lattices, written.skeleton.lattices);
  EXPECT_EQ(skeleton.palette, written.skeleton.palette);
  EXPECT_EQ(skeleton.objects, written.skeleton.objects);
  EXPECT_EQ(skeleton.source_triangles, 256u);
  EXPECT_EQ(skeleton.import.dropped_triangles, 3u);
  EXPECT_EQ(skeleton.import.warnings, written.skeleton.import.warnings);
  EXPECT_EQ(skeleton.levels(), 2u);
  EXPECT_EQ(pack.size(), std::filesystem::file_size(file));
  ASSERT_EQ(skeleton.chunks.size(), 3u);
  for (uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(pack.read_chunk(i).triangle_count(), written.chunks[i].triangle_count());
    EXPECT_EQ(pack.read_chunk(i).box(), written.chunks[i].box());
    EXPECT_EQ(skeleton.chunks[i].lattice, written.chunk_lattices[i]);
    EXPECT_EQ(pack.read_chunk(i).pieces(), written.chunks[i].pieces());
  }
}

TEST(Pack, the_content_hash_is_that_of_the_content) {
  SmallPack changed = small_pack();
  const uint64_t hash = Pack(write_pack(changed)).content_hash();
  EXPECT_EQ(Pack(write_pack(changed)).content_hash(), hash);
  changed.chunks[0].vertices[20].point.z -= 1;
  EXPECT_NE(Pack(write_pack(changed)).content_hash(), hash);
}

TEST(Pack, vertices_that_no_triangle_uses_are_not_kept) {
  SmallPack pack = small_pack();
  pack.chunks[1].vertices.insert(pack.chunks[1].vertices.begin(), ChunkVertex{{0, 0, 0}, 0});
  for (uint32_t& index : pack.chunks[1].indices) ++index;
  EXPECT_EQ(Pack(write_pack(pack)).read_chunk(1).vertices.size(), 4u);
}

TEST(Pack, a_writer_that_does_not_finish_leaves_no_file) {
  const auto file = std::filesystem::path(testing::TempDir()) / "triptych_unfinished.tpk";
  std::filesystem::remove(file);
  {
    PackWriter writer(file);
    writer.add_chunk(small_pack().chunks[0], 0);
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(Pack, a_file_cut_anywhere_is_refused) {
  const auto file = write_pack(small_pack());
  const std::string whole = read_text_file(file);
  for (size_t length = 0; length < whole.size();
       length += length < 64 || whole.size() - length < 80 ? 1 : 7) {
    EXPECT_NE(error_of(file, whole.substr(0, length)), "") << length;
  }
}

TEST(Pack, bytes_behind_the_table_are_refused) {
  const auto file = write_pack(small_pack());
  const std::string whole = read_text_file(file);
  EXPECT_EQ(error_of(file, whole + "abc"),
            ": byte " + std::to_string(whole.size()) + ": 3 bytes are left over after the section table");
}

TEST(Pack, a_flipped_byte_anywhere_is_refused_and_said_where) {
  const auto file = write_pack(small_pack());
  const std::string whole = read_text_file(file);
  const auto geometry_end = header_bytes + value_at<uint64_t>(whole, value_at<uint64_t>(whole, 16) + 16);
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x40);
    const std::string error = error_of(file, damaged);
    ASSERT_NE(error, "") << "byte " << i;
    if (i < header_bytes) continue;
    const bool geometry = i < geometry_end, table = i >= value_at<uint64_t>(whole, 16);
    EXPECT_NE(error.find(geometry ? "section GEOM: chunk"
                         : table  ? "section table"
                                  : "section SKEL"),
              std::string::npos)
        << i << error;
  }
}

/// Two packs of the same layout, to the byte: in the second the grids are lifted by other heights.
std::array<std::string, 2> twins() {
  std::array<std::string, 2> bytes;
  for (const bool second : {false, true}) {
    SmallPack pack = small_pack();
    if (second) {
      for (Chunk& chunk : pack.chunks) {
        for (ChunkVertex& vertex : chunk.vertices) vertex.point.z = vertex.point.z == 4 ? 3 : 0;
      }
      for (Drawable& drawable : pack.skeleton.drawables) drawable.error *= 1.5;
    }
    bytes[second] = read_text_file(write_pack(pack));
  }
  return bytes;
}

TEST(Pack, a_section_of_another_pack_is_refused_and_said_which) {
  const auto file = write_pack(small_pack());
  const auto both = twins();
  const std::string &one = both[0], &other = both[1];
  ASSERT_EQ(one.size(), other.size());
  const auto table = value_at<uint64_t>(one, 16);
  ASSERT_EQ(one.substr(table + 8, 16), other.substr(table + 8, 16));  // sections of the same place and size
  const auto geometry_end = header_bytes + value_at<uint64_t>(one, table + 16);
  const auto spliced = [&](uint64_t first, uint64_t end) {
    return error_of(file, one.substr(0, first) + other.substr(first, end - first) + one.substr(end));
  };
  EXPECT_NE(spliced(0, header_bytes).find("section table: byte"), std::string::npos);
  EXPECT_NE(spliced(header_bytes, geometry_end).find("section GEOM: chunk 0: byte 32"), std::string::npos);
  EXPECT_NE(spliced(geometry_end, table).find("section SKEL: byte"), std::string::npos);
  EXPECT_NE(spliced(table, one.size()).find("section table: byte"), std::string::npos);
  // With the table, and the header that goes with it, of the other.
  std::string sealed = one.substr(0, geometry_end) + other.substr(geometry_end);
  sealed.replace(0, header_bytes, other.substr(0, header_bytes));
  EXPECT_NE(error_of(file, sealed).find("section GEOM: chunk 0: byte 32"), std::string::npos);
  sealed =
      other.substr(0, header_bytes) + one.substr(header_bytes, table - header_bytes) + other.substr(table);
  EXPECT_NE(error_of(file, sealed).find("section SKEL: byte"), std::string::npos);
  // A skeleton that is the other's, and sealed as this one's: only the geometry's own checksum is left to say
  // so.
  std::string skeleton = one;
  skeleton.replace(geometry_end, table - geometry_end, other.substr(geometry_end, table - geometry_end));
  skeleton.replace(table + section_bytes, section_bytes, other.substr(table + section_bytes, section_bytes));
  seal_table(skeleton);
  EXPECT_NE(error_of(file, skeleton).find("section GEOM: its checksum"), std::string::npos);
}

TEST(Pack, chunks_that_changed_places_are_refused) {
  SmallPack pack = small_pack();
  pack.chunks[2] = pack.chunks[0];  // the same size, and another content
  for (ChunkVertex& vertex : pack.chunks[2].vertices) vertex.color = 1;
  const auto file = write_pack(pack);
  const std::string whole = read_text_file(file);
  const Pack opened(file);
  const ChunkInfo first = opened.skeleton().chunks[0], third = opened.skeleton().chunks[2];
  ASSERT_EQ(first.size, third.size);
  std::string swapped = whole;
  swapped.replace(header_bytes + first.offset, first.size,
                  whole.substr(header_bytes + third.offset, third.size));
  swapped.replace(header_bytes + third.offset, third.size,
                  whole.substr(header_bytes + first.offset, first.size));
  EXPECT_NE(error_of(file, swapped).find("section GEOM: chunk 0: byte 32"), std::string::npos);
  // Entries of the chunk table exchanged, and the skeleton sealed again.
  const auto table = value_at<uint64_t>(whole, 16);
  std::string entries = whole;
  const auto end = entries.begin() + static_cast<long>(table - sizeof(uint64_t));  // an empty array follows
  std::swap_ranges(end - 3 * 64, end - 2 * 64, end - 64);
  const auto skeleton_at = value_at<uint64_t>(whole, table + section_bytes + 8);
  put(entries, table + section_bytes + 24,
      hash_bytes(std::as_bytes(std::span(entries.data() + skeleton_at, table - skeleton_at))));
  seal_table(entries);
  EXPECT_NE(error_of(file, entries).find("section GEOM: its checksum"), std::string::npos);
}

TEST(Pack, table_entries_that_were_exchanged_or_doubled_are_refused) {
  const auto file = write_pack(small_pack());
  const std::string whole = read_text_file(file);
  const auto table = value_at<uint64_t>(whole, 16);
  const auto with_types = [&](const char* first, const char* second) {
    std::string changed = whole;
    changed.replace(table, 4, first);
    changed.replace(table + section_bytes, 4, second);
    seal_table(changed);
    return error_of(file, changed);
  };
  EXPECT_NE(with_types("SKEL", "GEOM").find("section SKEL"), std::string::npos);
  EXPECT_NE(with_types("GEOM", "GEOM").find("section table"), std::string::npos);
  EXPECT_NE(with_types("SKEL", "SKEL").find("section table"), std::string::npos);
  // A second entry of a kind that the table has already: which of them counts?
  for (const uint64_t entry : {table, table + section_bytes}) {
    std::string doubled = whole;
    doubled.insert(table, whole.substr(entry, section_bytes));
    put(doubled, 12, uint32_t{3});
    seal_table(doubled);
    EXPECT_NE(error_of(file, doubled).find("section table"), std::string::npos);
  }
}

TEST(Pack, another_version_and_another_kind_of_file_are_refused_by_name) {
  const auto file = write_pack(small_pack());
  std::string other = read_text_file(file);
  put(other, 8, uint32_t{instanced_pack_format_version + 1});
  EXPECT_NE(error_of(file, other).find("versions 2 and 3"), std::string::npos);
  std::string noise;
  for (int i = 0; i < 256 * 256; ++i) noise.push_back(static_cast<char>(i));
  EXPECT_NE(error_of(file, noise).find("is not a pack"), std::string::npos);
  EXPECT_THROW(Pack("/nonexistent/a.tpk"), Error);
  EXPECT_THROW(Pack{std::filesystem::path(testing::TempDir())}, Error);
}

TEST(Pack, sections_of_an_unknown_type_are_passed_over) {
  const auto file = write_pack(small_pack());
  std::string whole = read_text_file(file);
  const auto table = value_at<uint64_t>(whole, 16);
  std::string extra = "XTRA";
  extra.resize(section_bytes, '\x7f');
  whole.insert(table, extra);
  put(whole, 12, uint32_t{3});
  seal_table(whole);
  EXPECT_EQ(error_of(file, whole), "");
}

TEST(Pack, vertex_colours_give_the_geometry_a_version_of_its_own_and_come_back) {
  const std::filesystem::path plain = write_pack(small_pack());
  const std::string whole = read_text_file(plain);
  EXPECT_EQ(value_at<uint32_t>(whole, value_at<uint64_t>(whole, 16) + 4), geometry_version);
  SmallPack colored = small_pack();
  colored.skeleton.effects = {effect_name_in_pack(Effect::vertex_colors)};
  for (Chunk& chunk : colored.chunks) chunk.colors.resize(chunk.vertices.size(), {1, 2, 3, 255});
  const std::filesystem::path file = write_pack(colored);
  const std::string bytes = read_text_file(file);
  EXPECT_EQ(value_at<uint32_t>(bytes, value_at<uint64_t>(bytes, 16) + 4), colored_geometry_version);
  const Pack pack(file);
  EXPECT_EQ(pack.skeleton().effects, (std::vector<std::string>{effect_name_in_pack(Effect::vertex_colors)}));
  const Chunk chunk = pack.read_chunk(0);
  EXPECT_EQ(chunk.colors, std::vector<VertexColor>(chunk.vertices.size(), {1, 2, 3, 255}));
}

TEST(Pack, normals_give_the_geometry_a_version_and_an_effect_of_their_own_and_come_back) {
  for (const auto& [from, effect] :
       {std::pair<ChunkNormals, std::string>{ChunkNormals::of_levels, level_normals_effect},
        {ChunkNormals::of_files, effect_name_in_pack(Effect::smooth_normals)}}) {
    SmallPack shaded = small_pack();
    Chunk& chunk = shaded.chunks.front();
    chunk.normals.resize(chunk.vertices.size(), {700, 1500});
    chunk.normals_from = from;
    const std::filesystem::path file = write_pack(shaded);
    const std::string bytes = read_text_file(file);
    EXPECT_EQ(value_at<uint32_t>(bytes, value_at<uint64_t>(bytes, 16) + 4), shaded_geometry_version);
    const Pack pack(file);
    EXPECT_EQ(pack.skeleton().effects, std::vector<std::string>{effect});
    EXPECT_TRUE(has_normals(pack.skeleton().effects));
    const Chunk read = pack.read_chunk(0);
    EXPECT_EQ(read.normals, std::vector<VertexNormal>(read.vertices.size(), {700, 1500}));
    EXPECT_EQ(read.normals_from, from);
  }
}

TEST(Pack, a_pack_without_its_skeleton_or_with_a_newer_one_is_refused) {
  const auto file = write_pack(small_pack());
  std::string without = read_text_file(file);
  const auto table = value_at<uint64_t>(without, 16);
  put(without, table + section_bytes, std::array{'X', 'T', 'R', 'A'});
  seal_table(without);
  EXPECT_NE(error_of(file, without).find("SKEL"), std::string::npos);
  std::string newer = read_text_file(file);
  put(newer, table + section_bytes + 4, uint32_t{2});
  seal_table(newer);
  EXPECT_NE(error_of(file, newer).find("newer version"), std::string::npos);
}

TEST(Pack, a_skeleton_that_does_not_hold_together_is_refused) {
  const auto refused = [](auto&& change) {
    SmallPack pack = small_pack();
    change(pack.skeleton);
    try {
      const Pack opened(write_pack(pack));
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("section SKEL"), std::string::npos);
      return;
    }
    ADD_FAILURE() << "was opened";
  };
  refused([](Skeleton& s) { s.scene_nodes.clear(); });
  refused([](Skeleton& s) { s.scene_nodes[0].parent = 0; });
  refused([](Skeleton& s) { s.scene_nodes[1].parent = 2; });
  refused([](Skeleton& s) { s.scene_nodes[0].child_count = 3; });
  refused([](Skeleton& s) { s.scene_nodes[0].first_child = 0xffffffff; });
  refused([](Skeleton& s) { s.scene_nodes[0].first_child = 0; });
  refused([](Skeleton& s) { s.scene_nodes[1].drawable_count = 0; });
  refused([](Skeleton& s) { s.scene_nodes[2].first_drawable = 4; });
  refused([](Skeleton& s) { s.scene_nodes[2].box.hi.x = 0; });
  refused([](Skeleton& s) { s.scene_nodes[2].box.hi.x = Lattice::limit + 1; });
  refused([](Skeleton& s) { s.drawables[1].error = -1; });
  refused([](Skeleton& s) { s.drawables[1].error = std::numeric_limits<double>::quiet_NaN(); });
  refused([](Skeleton& s) { s.drawables[1].scene_node = 2; });
  refused([](Skeleton& s) { s.drawables[1].scene_node = 77; });
  refused([](Skeleton& s) { s.drawables[1].placement_count = 0xffffffff; });
  refused([](Skeleton& s) { ++s.drawables[1].triangles; });
  refused([](Skeleton& s) { s.placements[0].chunk = 3; });
  refused([](Skeleton& s) { s.placements[0].transform = 3; });
  refused([](Skeleton& s) { s.transforms[1][2].y = std::numeric_limits<double>::infinity(); });
  refused([](Skeleton& s) { s.lattices.pop_back(); });
  refused([](Skeleton& s) { s.lattices[0].step = 0; });
  refused([](Skeleton& s) { s.palette.clear(); });
}

TEST(PackSkeleton, pieces_that_do_not_hold_together_are_refused) {
  const auto decoded = [](auto&& change) {
    Skeleton skeleton = small_pack().skeleton;
    skeleton.chunks.assign(3, ChunkInfo{.size = 10, .box = {{0, 0, 0}, {1, 1, 1}}});
    skeleton.chunks[1].first_piece = skeleton.chunks[2].first_piece = 2;
    skeleton.pieces.assign(5, LatticeBox{{0, 0, 0}, {1, 0, 1}});
    for (Drawable& drawable : skeleton.drawables) drawable.triangles = 0;
    change(skeleton);
    return decode_skeleton(encode_skeleton(skeleton), 100, "skeleton");
  };
  const Skeleton skeleton = decoded([](Skeleton&) {});
  EXPECT_EQ(skeleton.pieces_of(0).size(), 2u);
  EXPECT_EQ(skeleton.pieces_of(1).data(), &skeleton.chunks[1].box);
  EXPECT_EQ(skeleton.pieces_of(2).size(), 3u);
  const auto refused = [&](auto&& change) { EXPECT_THROW(decoded(change), Error); };
  refused([](Skeleton& s) { s.chunks[0].first_piece = 1; });
  refused([](Skeleton& s) { s.chunks[1].first_piece = 3; });
  refused([](Skeleton& s) { s.chunks[2].first_piece = 4; });
  refused([](Skeleton& s) { s.chunks[2].first_piece = 6; });
  refused([](Skeleton& s) { s.pieces[3].hi.y = 2; });
  refused([](Skeleton& s) { s.pieces[0].lo.x = 2; });
  refused([](Skeleton& s) { s.pieces.clear(); });
  refused([](Skeleton& s) { s.pieces.resize(2 + max_chunk_pieces + 1, s.pieces[0]); });
}

TEST(PackSkeleton, bytes_cut_anywhere_or_changed_anywhere_never_crash) {
  Skeleton skeleton = small_pack().skeleton;
  skeleton.chunks.assign(3, ChunkInfo{.size = 10, .box = {{0, 0, 0}, {1, 1, 1}}});
  skeleton.chunks[2].first_piece = 3;
  skeleton.pieces.assign(5, LatticeBox{{0, 0, 0}, {1, 0, 1}});
  for (Drawable& drawable : skeleton.drawables) drawable.triangles = 0;
  const auto bytes = encode_skeleton(skeleton);
  EXPECT_NO_THROW(decode_skeleton(bytes, 100, "skeleton"));
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(decode_skeleton(std::span(bytes).first(length), 100, "skeleton"), Error);
  }
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto damaged = bytes;
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    try {
      decode_skeleton(damaged, 100, "skeleton");
    } catch (const Error&) {
    }
  }
}

}  // namespace
}  // namespace triptych
