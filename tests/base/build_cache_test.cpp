// What builds keep for the next one.
#include "base/build_cache.hpp"

#include "base/error.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace triptych {
namespace {

class Cache : public testing::Test {
 protected:
  Cache() {
    file = std::filesystem::path(testing::TempDir()) /
           ("cache_" + std::to_string(::getpid()) + "_" +
            testing::UnitTest::GetInstance()->current_test_info()->name());
  }
  ~Cache() override { std::filesystem::remove(file); }

  static ContentKey key(uint64_t number) {
    ContentKeyWriter writer;
    writer.write(number);
    return writer.key();
  }
  static std::vector<std::byte> bytes(uint64_t number) {
    return std::vector<std::byte>(static_cast<size_t>(number), static_cast<std::byte>(number));
  }
  /// Asks for these, and returns how many were found.
  uint64_t use(const std::vector<uint64_t>& numbers, bool commit = true, const ContentKey& program = {1, 2},
               std::optional<uint64_t> limit = std::nullopt) {
    BuildCache cache(file, program, limit);
    for (const uint64_t number : numbers)
      EXPECT_EQ(cache.get("numbers", key(number), [&] { return bytes(number); }), bytes(number));
    EXPECT_EQ(cache.count().found + cache.count().made, numbers.size());
    if (commit) cache.commit();
    left_out = cache.left_out_bytes();
    return cache.count().found;
  }

  std::filesystem::path file;
  uint64_t left_out = 0;
};

TEST_F(Cache, what_was_kept_is_found_by_the_next_build) {
  EXPECT_EQ(use({0, 1, 2, 300}), 0u);
  EXPECT_EQ(use({300, 2, 5, 0}), 3u);
}

TEST_F(Cache, keeps_only_what_the_last_build_asked_for) {
  use({100, 200, 300});
  const uint64_t size = std::filesystem::file_size(file);
  use({100});
  EXPECT_LT(std::filesystem::file_size(file), size - 400);
  EXPECT_EQ(use({100, 200}), 1u);
}

TEST_F(Cache, within_a_limit_keeps_what_earlier_builds_asked_for_the_latest_first) {
  constexpr uint64_t limit = 3900;
  for (const uint64_t number : {1000, 1500, 2000}) use({number}, true, {1, 2}, limit);
  EXPECT_LE(std::filesystem::file_size(file), limit);
  {
    const BuildCache cache(file, {1, 2});
    EXPECT_EQ(cache.find(key(2000)), bytes(2000));
    EXPECT_EQ(cache.find(key(1500)), bytes(1500));
    EXPECT_FALSE(cache.find(key(1000)).has_value());
  }
  use({1500}, true, {1, 2}, limit);  // now that is the latest
  use({1000}, true, {1, 2}, limit);
  const BuildCache cache(file, {1, 2});
  EXPECT_TRUE(cache.find(key(1500)).has_value());
  EXPECT_FALSE(cache.find(key(2000)).has_value());
}

TEST_F(Cache, never_passes_its_limit) {
  constexpr uint64_t limit = 4000;
  use({3000, 3001, 100}, true, {1, 2}, limit);
  EXPECT_LE(std::filesystem::file_size(file), limit);
  EXPECT_EQ(use({3000, 3001, 100}, true, {1, 2}, limit), 2u);
  EXPECT_EQ(left_out, 3001u + 48);
  use({3001}, true, {1, 2}, limit);  // what a build asks for goes first
  EXPECT_EQ(use({3001}, true, {1, 2}, limit), 1u);
  EXPECT_EQ(left_out, 0u);
}

TEST_F(Cache, does_not_go_on_with_what_is_damaged) {
  use({1000}, true, {1, 2}, 100000);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(500);
  stream.put('x');
  stream.close();
  use({2000}, true, {1, 2}, 100000);
  const BuildCache cache(file, {1, 2});
  EXPECT_FALSE(cache.find(key(1000)).has_value());
  EXPECT_EQ(cache.find(key(2000)), bytes(2000));
}

TEST_F(Cache, of_a_larger_limit_is_cut_to_a_smaller_one) {
  use({3000, 2000, 1000}, true, {1, 2}, 100000);
  use({500}, true, {1, 2}, 2000);
  EXPECT_LE(std::filesystem::file_size(file), 2000u);
  EXPECT_EQ(use({500, 1000}, true, {1, 2}, 100000), 2u);
}

TEST_F(Cache, counts_what_it_leaves_out_once) {
  BuildCache cache(file, {1, 2}, 1000);
  for (int i = 0; i < 2; ++i) cache.get("numbers", key(2000), [&] { return bytes(2000); });
  EXPECT_EQ(cache.left_out_bytes(), 2000u + 48);
}

TEST_F(Cache, stays_as_it_was_where_a_build_fails) {
  use({10, 20});
  use({30}, false);
  EXPECT_EQ(use({10, 20, 30}), 2u);
}

TEST_F(Cache, of_another_program_is_not_used) {
  use({10, 20});
  EXPECT_EQ(use({10, 20}, true, {3, 4}), 0u);
}

TEST_F(Cache, what_is_damaged_is_made_again) {
  for (const double share : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    use({1000, 2000, 3000});
    // Behind what names the kind of file.
    const auto at =
        8 + static_cast<std::streamoff>(share * static_cast<double>(std::filesystem::file_size(file) - 8));
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(at);
    const int byte = stream.get();
    stream.seekp(at);
    stream.put(static_cast<char>(byte ^ 4));
    stream.close();
    EXPECT_LT(use({1000, 2000, 3000}), 3u) << share;  // which compares what it gets
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_EQ(use({1000, 2000, 3000}), 0u) << share;
  }
}

TEST_F(Cache, is_written_over_no_file_of_another_kind) {
  std::ofstream(file) << "a list of the user's own";
  EXPECT_THROW(use({1000}), Error);
  std::ifstream kept(file);
  std::string text;
  std::getline(kept, text);
  EXPECT_EQ(text, "a list of the user's own");
}

TEST_F(Cache, renews_what_it_has_under_a_key) {
  const auto renew = [&](uint64_t expected, uint64_t now) {
    BuildCache cache(file, {1, 2});
    cache.renew("numbers", key(1), [&](const std::vector<std::byte>& before) {
      EXPECT_EQ(before, bytes(expected));
      return bytes(now);
    });
    cache.commit();
    return cache.count().found;
  };
  EXPECT_EQ(renew(0, 10), 0u);
  EXPECT_EQ(renew(10, 10), 1u);
  EXPECT_EQ(renew(10, 20), 0u);
  EXPECT_EQ(renew(20, 20), 1u);
}

TEST_F(Cache, keeps_files_and_hands_them_out_piece_by_piece) {
  const std::filesystem::path large = file.string() + "_large";
  std::string text(3'000'000, 'a');
  for (size_t i = 0; i < text.size(); i += 7) text[i] = static_cast<char>('b' + i % 23);
  std::ofstream(large, std::ios::binary) << text;
  {
    BuildCache cache(file, {1, 2});
    cache.keep_file(key(5), large);
    cache.keep(key(6), bytes(6));
    cache.commit();
  }
  std::filesystem::remove(large);
  const auto read = [&] {
    const BuildCache cache(file, {1, 2});
    EXPECT_EQ(cache.find(key(6)), bytes(6));
    EXPECT_FALSE(cache.find(key(7)).has_value());
    std::string found;
    const bool whole = cache.read(key(5), [&](std::span<const std::byte> piece) {
      found.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    });
    return whole ? found : "";
  };
  EXPECT_TRUE(read() == text);
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(1'500'000);
  stream.put('!');
  stream.close();
  EXPECT_TRUE(read().empty());
}

TEST_F(Cache, stays_as_it_was_where_the_disk_is_full_and_the_build_goes_on) {
  use({10, 20});
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  const rlimit little{20'000, old.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &little);
  EXPECT_THROW(use({10, 100'000, 200'000, 20}),
               Error);  // and compares what it got until then
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(use({10, 20}), 2u);
}

}  // namespace
}  // namespace triptych
