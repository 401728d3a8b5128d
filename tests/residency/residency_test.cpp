// The contract of residency, held by the one that reads when it is asked and by the one that reads ahead.
#include "base/error.hpp"
#include "residency/load_on_demand.hpp"
#include "residency/read_ahead.hpp"
#include "tests/support/hooked_source.hpp"
#include "tests/support/small_pack.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <thread>

namespace triptych {
namespace {

class Residencies : public testing::Test {
 protected:
  const std::filesystem::path file = test::write_pack(test::small_pack());
  const Pack pack{file};
  const uint32_t chunks = static_cast<uint32_t>(pack.skeleton().chunks.size());

  void check(Chunk chunk, uint32_t index) const {
    const Chunk own = pack.read_chunk(index);
    EXPECT_EQ(chunk.vertices, own.vertices) << index;
    EXPECT_EQ(chunk.indices, own.indices) << index;
  }
  void damage_first_chunk() const {
    // It begins behind the header of 32 bytes.
    std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
    bytes.seekp(40);
    bytes.put('\x5a');
  }
  static void wait_until_read(const ReadAhead& residency, uint64_t count) {
    while (residency.use().read_ahead < count) std::this_thread::yield();
  }
};

TEST_F(Residencies, give_chunks_as_the_pack_has_them_and_again) {
  LoadOnDemand on_demand(pack);
  ReadAhead ahead(pack, 2, 1 << 20);
  for (Residency* residency : {static_cast<Residency*>(&on_demand), static_cast<Residency*>(&ahead)}) {
    for (uint32_t chunk = 0; chunk < chunks; ++chunk) residency->expect(chunk, 1);
    for (const int round : {0, 1}) {
      for (uint32_t chunk = 0; chunk < chunks; ++chunk) check(residency->take(chunk), chunk);
      EXPECT_LT(round, 2);
    }
  }
}

TEST_F(Residencies, what_is_expected_is_there_before_it_is_taken) {
  ReadAhead residency(pack, 1, 1 << 20);
  for (uint32_t chunk = 0; chunk < chunks; ++chunk) residency.expect(chunk, 0);
  residency.expect(0, 3);  // once more, which changes nothing that is read
  wait_until_read(residency, chunks);
  EXPECT_GT(residency.use().bytes, 0u);
  for (uint32_t chunk = 0; chunk < chunks; ++chunk) check(residency.take(chunk), chunk);
  const ReadAheadUse use = residency.use();
  EXPECT_EQ(use.read_ahead, chunks);
  EXPECT_EQ(use.in_time, chunks);
  EXPECT_EQ(use.taken, chunks);
  EXPECT_EQ(use.dropped, 0u);
  EXPECT_EQ(use.bytes, 0u);
}

TEST_F(Residencies, no_more_is_read_ahead_than_may_be_held_until_it_is_taken_or_expected_no_longer) {
  ReadAhead residency(pack, 1, 1);  // one chunk at a time
  residency.expect(0, 1);
  residency.expect(1, 0);
  wait_until_read(residency, 1);
  EXPECT_EQ(residency.use().open, 2u) << "one is ready, one waits";
  check(*residency.take_if_ready(0), 0);
  wait_until_read(residency, 2);
  for (int frame = 0; frame < 3; ++frame) residency.next_frame();
  EXPECT_EQ(residency.use().dropped, 1u);
  EXPECT_EQ(residency.use().open, 0u);
  EXPECT_EQ(residency.use().bytes, 0u);
}

TEST_F(Residencies, what_is_urgent_is_read_in_place_of_what_is_not) {
  ReadAhead residency(pack, 1, 1);
  residency.expect(0, 1);
  wait_until_read(residency, 1);
  EXPECT_FALSE(residency.take_if_ready(1).has_value());
  wait_until_read(residency, 2);
  EXPECT_EQ(residency.use().dropped, 1u);
  check(*residency.take_if_ready(1), 1);
}

TEST_F(Residencies, chunks_that_lie_side_by_side_are_read_together_where_that_is_liked) {
  ASSERT_GT(chunks, 2u);
  for (const bool joins : {false, true}) {
    auto source = std::make_unique<const test::HookedSource>(
        file, ByteSource::Habits{.threads = 0, .most_at_once = joins ? uint64_t{1} << 20 : 0});
    const test::HookedSource& counted = *source;
    const Pack joining(std::move(source));
    ReadAhead residency(joining, 0, 1 << 20);  // nobody reads but who takes
    const uint64_t before = counted.reads;
    for (uint32_t chunk = 0; chunk < chunks; ++chunk) residency.expect(chunk, urgent);
    check(residency.take(1), 1);
    for (uint32_t chunk = 0; chunk < chunks; ++chunk) {
      if (chunk != 1) check(residency.take(chunk), chunk);
    }
    EXPECT_EQ(counted.reads - before, joins ? 1u : chunks);
    EXPECT_EQ(residency.use().reads, joins ? 1u : chunks);
    EXPECT_EQ(residency.use().bytes, 0u);
    EXPECT_EQ(residency.use().open, 0u);
  }
}

TEST_F(Residencies, damage_in_what_is_read_together_is_of_its_chunk_alone) {
  damage_first_chunk();
  const Pack joining(std::make_unique<const test::HookedSource>(
      file, ByteSource::Habits{.most_at_once = uint64_t{1} << 20}));
  ReadAhead residency(joining, 0, 1 << 20);
  for (uint32_t chunk = 0; chunk < chunks; ++chunk) residency.expect(chunk, urgent);
  for (uint32_t chunk = 1; chunk < chunks; ++chunk) EXPECT_NO_THROW(residency.take(chunk)) << chunk;
  EXPECT_THROW(residency.take(0), Error);
}

TEST_F(Residencies, what_is_not_ready_is_expected_urgently) {
  ReadAhead residency(pack, 0, 1 << 20);  // nobody reads
  EXPECT_FALSE(residency.take_if_ready(1).has_value());
  EXPECT_EQ(residency.use().open, 1u);
  residency.next_frame();
  EXPECT_EQ(residency.use().open, 0u) << "the next frame asks again";
  check(residency.take(1), 1);
  LoadOnDemand on_demand(pack);
  check(*on_demand.take_if_ready(1), 1);
}

TEST_F(Residencies, damage_is_an_error_of_whoever_takes_that_chunk) {
  damage_first_chunk();
  LoadOnDemand on_demand(pack);
  EXPECT_THROW(on_demand.take(0), Error);
  EXPECT_NO_THROW(on_demand.take(1));
  ReadAhead residency(pack, 1, 1 << 20);
  residency.expect(0, 1);
  residency.expect(1, 0);
  wait_until_read(residency, 2);
  EXPECT_THROW(residency.take(0), Error);
  EXPECT_THROW(residency.take(0), Error) << "read anew";
  check(residency.take(1), 1);
}

TEST_F(Residencies, taking_and_expecting_side_by_side_loses_nothing) {
  ReadAhead residency(pack, 2, 1);
  for (uint32_t round = 0; round < 2000; ++round) {
    residency.expect(round % chunks, static_cast<float>(round % 7));
    if (round % 5 == 0) residency.next_frame();
    if (round % 3 == 0) {
      if (const auto chunk = residency.take_if_ready(round % chunks)) check(*chunk, round % chunks);
    }
    check(residency.take((round * 7 + 3) % chunks), (round * 7 + 3) % chunks);
  }
  EXPECT_GE(residency.use().taken, 2000u);
}

}  // namespace
}  // namespace triptych
