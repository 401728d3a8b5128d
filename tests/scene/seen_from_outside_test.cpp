// The section SEEN: what is written is read when the pack is opened, and damage is one error.
#include "scene/seen_from_outside.hpp"

#include "base/bytes.hpp"
#include "preprocess/pack_writer.hpp"
#include "tests/support/pack_bytes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace test;

std::string decode_error(const std::vector<uint32_t>& chunks, size_t count) {
  ByteWriter writer;
  writer.write(static_cast<uint64_t>(chunks.size()));
  for (const uint32_t chunk : chunks) writer.write(chunk);
  try {
    decode_seen_from_outside(writer.bytes(), count, "here");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// The small pack, its second chunk marked.
std::filesystem::path write_marked() {
  const std::filesystem::path file = write_pack(small_pack());
  const SmallPack small = small_pack();
  PackWriter writer(file);
  for (size_t i = 0; i < small.chunks.size(); ++i) {
    EncodedChunk chunk(small.chunks[i]);
    chunk.seen_from_outside = i == 1;
    writer.add_chunk(chunk, small.chunk_lattices[i]);
  }
  writer.finish(small.skeleton);
  return file;
}

TEST(SeenFromOutside, is_read_when_the_pack_is_opened) {
  const Pack pack(write_marked());
  const Skeleton& skeleton = pack.skeleton();
  ASSERT_EQ(skeleton.seen_from_outside.size(), skeleton.chunks.size());
  for (size_t chunk = 0; chunk < skeleton.chunks.size(); ++chunk)
    EXPECT_EQ(skeleton.seen_from_outside[chunk], chunk == 1);
  for (const Drawable& drawable : skeleton.drawables) {
    bool places = false;
    for (uint32_t i = 0; i < drawable.placement_count; ++i)
      places = places || skeleton.placements[drawable.first_placement + i].chunk == 1;
    EXPECT_EQ(is_seen_from_outside(skeleton, drawable), places);
  }
  const uint64_t hash = pack.content_hash();
  const Pack without(write_pack(small_pack()));
  EXPECT_TRUE(without.skeleton().seen_from_outside.empty());
  EXPECT_NE(without.content_hash(), hash) << "other levels are drawn";
}

TEST(SeenFromOutside, that_is_damaged_is_one_error) {
  const auto file = write_marked();
  const std::string whole = read_text_file(file);
  const size_t entry = value_at<uint64_t>(whole, 16) + 2 * section_bytes;
  ASSERT_EQ(whole.substr(entry, 4), "SEEN");
  const auto begin = value_at<uint64_t>(whole, entry + 8), size = value_at<uint64_t>(whole, entry + 16);
  for (uint64_t i = begin; i < begin + size; ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_NE(error_of(file).find("section SEEN: byte"), std::string::npos) << i;
  }
}

TEST(SeenFromOutside, names_chunks_that_are_there_in_their_order) {
  EXPECT_EQ(decode_error({0, 2}, 3), "");
  EXPECT_NE(decode_error({0, 3}, 3), "");
  EXPECT_NE(decode_error({2, 1}, 3), "");
  EXPECT_NE(decode_error({1, 1}, 3), "");
}

}  // namespace
}  // namespace triptych
