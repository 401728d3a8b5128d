// The section OPTS: what is written is read, by whom it is asked for, and damage is one error.
#include "scene/pack_options.hpp"

#include "base/bytes.hpp"
#include "tests/support/pack_bytes.hpp"
#include "tests/support/small_pack.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

using namespace test;

const PackOptions some = {{"bake-instances", "no"}, {"keep", "cover,touching"}, {"part-triangles", "4096"}};

std::string options_error_of(const std::filesystem::path& file) {
  try {
    Pack(file).read_options();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string decode_error(const std::vector<std::byte>& bytes) {
  try {
    decode_pack_options(bytes, "here");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

/// A section of these pairs, as they come.
std::vector<std::byte> section_of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  ByteWriter writer;
  writer.write(static_cast<uint32_t>(pairs.size()));
  for (const auto& [name, value] : pairs) {
    writer.write_text(name);
    writer.write_text(value);
  }
  return std::move(writer.bytes());
}

TEST(PackOptions, are_read_back_and_are_no_part_of_the_content) {
  const Pack with(write_pack(small_pack(), some));
  EXPECT_EQ(with.read_options(), some);
  const uint64_t hash = with.content_hash();
  const uint32_t version = with.format_version();
  const Pack without(write_pack(small_pack()));
  EXPECT_TRUE(without.read_options().empty()) << "a pack of an earlier program says nothing";
  EXPECT_EQ(without.content_hash(), hash);
  EXPECT_EQ(without.format_version(), version);
}

TEST(PackOptions, that_are_damaged_or_of_another_version_are_one_error_where_they_are_asked_for) {
  const auto file = write_pack(small_pack(), some);
  const std::string whole = read_text_file(file);
  const auto table = value_at<uint64_t>(whole, 16);
  const size_t entry = table + 2 * section_bytes;
  ASSERT_EQ(whole.substr(entry, 4), "OPTS");
  const auto begin = value_at<uint64_t>(whole, entry + 8), size = value_at<uint64_t>(whole, entry + 16);
  for (uint64_t i = begin; i < begin + size; ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_NE(options_error_of(file).find("section OPTS: byte"), std::string::npos) << i;
    EXPECT_EQ(error_of(file), "") << "nothing that is drawn depends on it";
  }
  std::string newer = whole;
  put(newer, entry + 4, 2u);
  seal_table(newer);
  std::ofstream(file, std::ios::binary) << newer;
  EXPECT_NE(options_error_of(file).find("section OPTS: is of version 2"), std::string::npos);
  std::string huge = whole;
  put(huge, entry + 16, uint64_t{1} << 40);
  seal_table(huge);
  std::ofstream(file, std::ios::binary) << huge;
  EXPECT_NE(options_error_of(file).find("more than 65536"), std::string::npos);
}

TEST(PackOptions, out_of_order_twice_or_unprintable_are_refused) {
  EXPECT_EQ(decode_error(section_of({{"a", "1"}, {"b", ""}})), "");
  EXPECT_NE(decode_error(section_of({{"b", "1"}, {"a", ""}})).find("here: byte 14: option \"a\" does not"),
            std::string::npos);
  EXPECT_NE(decode_error(section_of({{"a", "1"}, {"a", "1"}})), "");
  EXPECT_NE(decode_error(section_of({{"", "1"}})), "");
  EXPECT_NE(decode_error(section_of({{"Keep", "1"}})), "");
  EXPECT_NE(decode_error(section_of({{"keep", "a\nb"}})), "");
  EXPECT_NE(decode_error(section_of({{"keep", "\x7f"}})), "");
  auto bytes = section_of({{"keep", "touching"}});
  bytes.push_back(std::byte{0});
  EXPECT_NE(decode_error(bytes), "");
  bytes.resize(bytes.size() - 2);
  EXPECT_NE(decode_error(bytes), "");
  EXPECT_NE(decode_error(section_of({{"keep", std::string(70000, 'a')}})).find("more than 65536"),
            std::string::npos);
  EXPECT_THROW(encode_pack_options({{"keep", std::string(70000, 'a')}}), Error);
}

TEST(PackOptions, have_a_word_where_it_is_whole) {
  EXPECT_TRUE(has_word(some, "keep", "touching"));
  EXPECT_TRUE(has_word(some, "keep", "cover"));
  EXPECT_FALSE(has_word(some, "keep", "touch"));
  EXPECT_FALSE(has_word(some, "keep", "cover,touching,"));
  EXPECT_FALSE(has_word(some, "bound", "fast"));
}

}  // namespace
}  // namespace triptych
