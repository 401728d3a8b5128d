#include "residency/chunk_cache.hpp"

#include <gtest/gtest.h>

namespace triptych {
namespace {

constexpr uint32_t none = ChunkCache::none;

TEST(ChunkCache, what_was_not_used_for_longest_goes_first_and_the_views_own_stays) {
  ChunkCache cache(4);
  cache.set_cap(30);
  for (const uint32_t chunk : {2u, 0u, 1u}) cache.add(chunk, 10, 5, 1);
  EXPECT_EQ(cache.next_to_go(0), none);
  EXPECT_THROW(cache.next_to_go(1), NoRoom) << "all are of this view";
  cache.begin_view();
  cache.touch(2);
  cache.touch(2);
  EXPECT_EQ(cache.use().view_bytes, 10u) << "once";
  EXPECT_EQ(cache.next_to_go(10), 0u);
  cache.remove(0);
  EXPECT_FALSE(cache.has(0));
  EXPECT_EQ(cache.next_to_go(10), none);
  cache.add(3, 10, 5, 1);
  EXPECT_EQ(cache.next_to_go(1), 1u);
  cache.remove(1);
  try {
    cache.next_to_go(11);
    FAIL() << "2 and 3 are of this view";
  } catch (const NoRoom& error) {
    EXPECT_EQ(error.needed(), 31u);
  }
  const GeometryUse& use = cache.use();
  EXPECT_EQ(use.bytes, 20u);
  EXPECT_EQ(use.peak_bytes, 30u);
  EXPECT_EQ(use.view_bytes, 20u);
  EXPECT_EQ(use.loaded_chunks, 4u);
  EXPECT_EQ(use.evicted_chunks, 2u);
  EXPECT_EQ(use.reloaded_chunks, 0u);
  EXPECT_EQ(use.read_bytes, 20u);
}

TEST(ChunkCache, counts_what_comes_again) {
  ChunkCache cache(2);
  cache.add(0, 10, 5, 1);
  cache.begin_view();
  EXPECT_EQ(cache.least_recently_used(), 0u);
  cache.remove(0);
  EXPECT_EQ(cache.least_recently_used(), none);
  cache.add(0, 10, 5, 1);
  EXPECT_EQ(cache.use().reloaded_chunks, 1u);
  EXPECT_EQ(cache.use().wait_ms, 2);
}

TEST(ChunkCache, a_cap_that_is_lowered_lets_the_oldest_go) {
  ChunkCache cache(3);
  for (const uint32_t chunk : {0u, 1u, 2u}) cache.begin_view(), cache.add(chunk, 10, 0, 0);
  cache.set_cap(10);
  EXPECT_EQ(cache.next_to_go(0), 0u);
  cache.remove(0);
  EXPECT_EQ(cache.next_to_go(0), 1u);
  cache.remove(1);
  EXPECT_EQ(cache.next_to_go(0), none);
}

}  // namespace
}  // namespace triptych
