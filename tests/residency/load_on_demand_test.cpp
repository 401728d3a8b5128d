// The contract of residency, held by the one that loads when it is asked.
#include "residency/load_on_demand.hpp"

#include "base/error.hpp"
#include "tests/support/small_pack.hpp"

#include <fstream>
#include <gtest/gtest.h>
#include <limits>

namespace triptych {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

class ResidencyOnDemand : public testing::Test {
 protected:
  const std::filesystem::path file = test::write_pack(test::small_pack());
  const Pack pack{file};
  LoadOnDemand residency{pack};
};

TEST_F(ResidencyOnDemand, has_nothing_that_nobody_asked_for) {
  EXPECT_EQ(residency.pin(0), nullptr);
  EXPECT_EQ(residency.memory_bytes(), 0u);
  EXPECT_EQ(residency.pump(forever), 0u);
}

TEST_F(ResidencyOnDemand, gets_what_was_requested_and_gives_it_as_the_pack_has_it) {
  for (uint32_t chunk = 0; chunk < pack.skeleton().chunks.size(); ++chunk) residency.request(chunk, 0);
  EXPECT_EQ(residency.pump(forever), 0u);
  for (uint32_t chunk = 0; chunk < pack.skeleton().chunks.size(); ++chunk) {
    const Chunk* geometry = residency.pin(chunk);
    ASSERT_NE(geometry, nullptr);
    const Chunk expected = pack.read_chunk(chunk);
    EXPECT_EQ(geometry->vertices, expected.vertices);
    EXPECT_EQ(geometry->indices, expected.indices);
    residency.unpin(chunk);
  }
}

TEST_F(ResidencyOnDemand, without_time_does_nothing_and_keeps_the_requests) {
  residency.request(0, 0);
  residency.request(1, 0);
  EXPECT_EQ(residency.pump(0), 2u);
  EXPECT_EQ(residency.pin(0), nullptr);
  EXPECT_EQ(residency.pump(forever), 0u);
  EXPECT_NE(residency.pin(0), nullptr);
}

TEST_F(ResidencyOnDemand, what_is_pinned_stays_until_the_last_pin_is_gone) {
  residency.request(0, 0);
  residency.pump(forever);
  residency.pin(0);
  residency.pin(0);
  const uint64_t bytes = residency.memory_bytes();
  EXPECT_GT(bytes, 0u);
  residency.evict(0);
  residency.unpin(0);
  residency.evict(0);
  EXPECT_EQ(residency.memory_bytes(), bytes);
  residency.unpin(0);
  residency.evict(0);
  EXPECT_EQ(residency.memory_bytes(), 0u);
  EXPECT_EQ(residency.pin(0), nullptr);
}

TEST_F(ResidencyOnDemand, asking_twice_is_asking_once) {
  residency.request(0, 0);
  residency.request(0, 5);
  EXPECT_EQ(residency.pump(forever), 0u);
  const uint64_t bytes = residency.memory_bytes();
  residency.request(0, 0);
  EXPECT_EQ(residency.pump(forever), 0u);
  EXPECT_EQ(residency.memory_bytes(), bytes);
}

TEST_F(ResidencyOnDemand, damage_is_an_error_of_its_chunk_and_the_others_come_all_the_same) {
  // Chunk 0 begins behind the header of 32 bytes.
  std::fstream bytes(file, std::ios::in | std::ios::out | std::ios::binary);
  bytes.seekp(40);
  bytes.put('\x5a');
  bytes.close();
  residency.request(0, 1);
  residency.request(1, 0);
  EXPECT_THROW(residency.pump(forever), Error);
  EXPECT_EQ(residency.pump(forever), 0u);
  EXPECT_EQ(residency.pin(0), nullptr);
  EXPECT_NE(residency.pin(1), nullptr);
}

}  // namespace
}  // namespace triptych
