#include "base/bytes.hpp"
#include "base/distribution.hpp"
#include "base/file.hpp"
#include "base/hashing.hpp"
#include "base/inject.hpp"
#include "base/threads.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <sys/stat.h>

namespace triptych {
namespace {

namespace fs = std::filesystem;

/// A folder of the running test's own, empty.
fs::path test_folder() {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder = fs::path(testing::TempDir()) / "triptych_base" / test->name();
  fs::remove_all(folder);
  make_folder(folder);
  return folder;
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Error, says_its_place_and_then_what_is_wrong) {
  EXPECT_EQ(message_of([] { fail("scene.obj: line 3", "names vertex {} of {}", 9, 4); }),
            "scene.obj: line 3: names vertex 9 of 4");
}

TEST(Bytes, what_is_written_is_read_back) {
  ByteWriter writer;
  writer.write(uint32_t{7});
  writer.write(-0.5);
  writer.write_text("wörter");
  const std::vector<uint16_t> values = {1, 2, 65535};
  writer.write_all(std::span<const uint16_t>(values));
  ByteReader reader(writer.bytes(), "place");
  EXPECT_EQ(reader.read<uint32_t>(), 7u);
  EXPECT_EQ(reader.read<double>(), -0.5);
  EXPECT_EQ(reader.read_text(), "wörter");
  EXPECT_EQ(reader.read_all<uint16_t>(3), values);
  reader.expect_end();
}

TEST(Bytes, plain_values_are_little_endian) {
  ByteWriter writer;
  writer.write(uint32_t{0x04030201});
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(std::to_integer<size_t>(writer.bytes()[i]), i + 1);
}

TEST(Bytes, numbers_of_every_length_survive_the_variable_coding) {
  for (int shift = 0; shift < 64; ++shift) {
    for (const uint64_t value : {uint64_t{1} << shift, (uint64_t{1} << shift) - 1, ~uint64_t{0} >> shift}) {
      ByteWriter writer;
      writer.write_varint(value);
      EXPECT_LE(writer.bytes().size(), 10u);
      ByteReader reader(writer.bytes(), "place");
      EXPECT_EQ(reader.read_varint(), value);
      reader.expect_end();
    }
  }
}

TEST(Bytes, a_variable_number_of_more_than_64_bits_is_refused) {
  for (const int last : {0x02, 0x80, 0xff}) {
    std::vector<std::byte> bytes(9, std::byte{0xff});
    bytes.push_back(static_cast<std::byte>(last));
    bytes.push_back(std::byte{1});
    EXPECT_THROW(ByteReader(bytes, "place").read_varint(), Error) << last;
  }
}

TEST(Bytes, reading_beyond_the_end_says_where) {
  ByteWriter writer;
  writer.write(uint32_t{0xffffffff});
  const auto& bytes = writer.bytes();
  EXPECT_EQ(message_of([&] { ByteReader(bytes, "peer").read<uint64_t>(); }),
            "peer: byte 0: ends too soon, 4 more bytes needed");
  EXPECT_NE(message_of([&] { ByteReader(bytes, "peer").read_text(); }), "");
  EXPECT_NE(message_of([&] { ByteReader(bytes, "peer").read_all<double>(~uint64_t{0}); }), "");
  EXPECT_NE(message_of([&] { ByteReader({}, "peer").read_varint(); }), "");
  EXPECT_EQ(message_of([&] { ByteReader(bytes, "peer").expect_end(); }), "peer: byte 0: 4 bytes too many");
}

TEST(Distribution, percentiles_are_values_that_were_measured) {
  std::vector<double> values;
  for (int i = 100; i >= 1; --i) values.push_back(i);
  const Distribution result = distribution(values);
  EXPECT_DOUBLE_EQ(result.mean, 50.5);
  EXPECT_EQ(result.p50, 50);
  EXPECT_EQ(result.p95, 95);
  EXPECT_EQ(result.p99, 99);
  EXPECT_EQ(result.max, 100);
}

TEST(Distribution, one_value_is_all_percentiles_and_no_values_are_zero) {
  const std::vector<double> one = {3};
  EXPECT_EQ(distribution(one).p50, 3);
  EXPECT_EQ(distribution(one).p99, 3);
  EXPECT_EQ(distribution({}).max, 0);
}

TEST(File, an_atomic_file_appears_with_commit_and_not_before) {
  const fs::path folder = test_folder(), file = folder / "a.txt";
  write_file(file, "old");
  {
    AtomicFile writer(file);
    writer.write("new and longer");
    EXPECT_EQ(read_text_file(file), "old");
    writer.commit();
  }
  EXPECT_EQ(read_text_file(file), "new and longer");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST(File, an_atomic_file_without_commit_leaves_nothing) {
  const fs::path folder = test_folder();
  {
    AtomicFile writer(folder / "a.txt");
    writer.write("half");
  }
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(File, an_earlier_place_can_be_overwritten_and_the_end_stays_where_it_was) {
  const fs::path file = test_folder() / "a.txt";
  AtomicFile writer(file);
  writer.write("____ body");
  writer.write_at(0, std::as_bytes(std::span("HEAD", 4)));
  writer.write(" end");
  EXPECT_EQ(writer.size(), 13u);
  writer.commit();
  EXPECT_EQ(read_text_file(file), "HEAD body end");
}

TEST(File, folders_missing_files_and_places_that_cannot_be_written_are_errors_that_name_them) {
  const fs::path folder = test_folder();
  EXPECT_NE(message_of([&] { read_file(folder); }).find(folder.string()), std::string::npos);
  EXPECT_NE(message_of([&] { read_text_file(folder / "none"); }).find("none"), std::string::npos);
  EXPECT_THROW(AtomicFile(folder / "no" / "folder.txt"), Error);
  EXPECT_THROW(AtomicFile{folder}, Error);
  write_file(folder / "file", "");
  EXPECT_THROW(make_folder(folder / "file" / "below"), Error);
}

TEST(File, a_pipe_or_a_device_is_not_replaced) {
  const fs::path folder = test_folder(), pipe = folder / "pipe", link = folder / "link";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  fs::create_symlink(pipe, link);
  for (const fs::path& file : {pipe, link}) {
    EXPECT_NE(message_of([&] { write_file(file, "text"); }).find("not a regular file"), std::string::npos);
    EXPECT_THROW(AtomicFile(file, folder / "partial", KeptBytes{}), Error);
  }
  EXPECT_TRUE(fs::is_fifo(pipe));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_FALSE(fs::exists(folder / "partial"));
}

TEST(Hashing, depends_on_every_bit_on_the_length_and_on_the_seed) {
  std::vector<std::byte> bytes(100);
  const uint64_t whole = hash_bytes(bytes);
  EXPECT_EQ(whole, hash_bytes(std::vector<std::byte>(100)));
  EXPECT_NE(whole, hash_bytes(std::vector<std::byte>(99)));
  EXPECT_NE(whole, hash_bytes(bytes, 1));
  for (size_t bit = 0; bit < 800; ++bit) {
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(whole, hash_bytes(bytes)) << bit;
    bytes[bit / 8] ^= std::byte{1} << (bit % 8);
  }
}

TEST(Hashing, is_the_same_on_every_machine) {
  // XXH3-64 of nothing, as xxHash's own documentation of its test vectors has it.
  EXPECT_EQ(hash_bytes({}), 0x2d06800538d394c2u);
}

TEST(Hashing, of_stretches_it_is_that_of_the_whole) {
  std::vector<std::byte> bytes(5000);
  for (size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::byte>(i * 7);
  EXPECT_EQ(StreamHash().checksum(), hash_bytes({}));
  for (const size_t step : {1, 63, 256, 4999, 5000}) {
    StreamHash hash;
    for (size_t at = 0; at < bytes.size(); at += step)
      hash.add(std::span(bytes).subspan(at, std::min(step, bytes.size() - at)));
    EXPECT_EQ(hash.checksum(), hash_bytes(bytes)) << step;
  }
}

TEST(Inject, faults_are_known_by_their_names_until_they_are_forgotten) {
  clear_injected();
  EXPECT_FALSE(injected(Fault::wrong_delta));
  EXPECT_TRUE(inject("wrong-delta"));
  EXPECT_FALSE(inject("no-such-fault"));
  EXPECT_TRUE(injected(Fault::wrong_delta));
  EXPECT_FALSE(injected(Fault::withheld_id));
  EXPECT_EQ(injected_names(), std::vector<std::string>{"wrong-delta"});
  clear_injected();
  EXPECT_TRUE(injected_names().empty());
}

TEST(Threads, every_index_is_visited_once_for_any_number_of_threads) {
  for (const unsigned threads : {1u, 2u, 0u}) {
    set_thread_count(threads);
    std::vector<int> visits(1000);
    parallel_for(visits.size(), [&](size_t i) { ++visits[i]; });
    EXPECT_EQ(visits, std::vector<int>(1000, 1));
  }
}

TEST(Threads, an_exception_comes_out) {
  EXPECT_THROW(parallel_for(10,
                            [](size_t i) {
                              if (i == 7) fail("index", "{}", i);
                            }),
               Error);
}

}  // namespace
}  // namespace triptych
