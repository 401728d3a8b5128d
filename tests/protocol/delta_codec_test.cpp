// Deltas come back as they were, take few bytes, and no bytes make the decoder do harm.
#include "protocol/delta_codec.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <rapidcheck/gtest.h>
#include <set>

namespace triptych {
namespace {

VisibleSet ascending(std::vector<DrawableId> ids) {
  const std::set<DrawableId> sorted(ids.begin(), ids.end());
  return {sorted.begin(), sorted.end()};
}

void expect_round_trip(const VisibleDelta& delta) {
  EXPECT_EQ(decode_delta(encode_delta(delta), "test"), delta);
}

RC_GTEST_PROP(DeltaCodec, any_delta_comes_back,
              (std::vector<DrawableId> added, std::vector<DrawableId> removed)) {
  const VisibleDelta delta{ascending(std::move(added)), ascending(std::move(removed))};
  RC_ASSERT(decode_delta(encode_delta(delta), "test") == delta);
}

RC_GTEST_PROP(DeltaCodec, crowded_deltas_come_back, ()) {
  const auto near = rc::gen::container<std::vector<DrawableId>>(rc::gen::inRange<DrawableId>(0, 300));
  const auto base = *rc::gen::element<DrawableId>(0, 1000, no_id - 300);
  VisibleDelta delta{ascending(*near), ascending(*near)};
  for (auto* ids : {&delta.added, &delta.removed}) {
    for (DrawableId& id : *ids) id += base;
  }
  RC_ASSERT(decode_delta(encode_delta(delta), "test") == delta);
}

RC_GTEST_PROP(DeltaCodec, any_bytes_are_refused_or_are_the_one_encoding_of_a_delta,
              (std::vector<uint8_t> noise)) {
  const auto bytes = std::as_bytes(std::span<const uint8_t>(noise));
  try {
    const VisibleDelta delta = decode_delta(bytes, "test");
    RC_ASSERT(std::ranges::equal(encode_delta(delta), bytes));
  } catch (const Error&) {
    RC_SUCCEED("refused");
  }
}

TEST(DeltaCodec, the_ends_of_the_id_range_come_back) {
  expect_round_trip({});
  expect_round_trip({{0}, {}});
  expect_round_trip({{}, {0}});
  expect_round_trip({{0xffffffff}, {}});
  expect_round_trip({{0, 0xffffffff}, {1, 0xfffffffe}});
  expect_round_trip({{0x7fffffff, 0x80000000}, {0x80000001}});
}

TEST(DeltaCodec, an_id_on_both_lists_comes_back) {
  expect_round_trip({{0, 5, 6, 0xffffffff}, {0, 5, 7, 0xffffffff}});
}

TEST(DeltaCodec, a_million_neighbours_take_few_bytes) {
  VisibleDelta delta;
  delta.added.resize(1'000'000);
  std::iota(delta.added.begin(), delta.added.end(), 7u);
  expect_round_trip(delta);
  EXPECT_LT(encode_delta(delta).size(), 10'000u);
}

TEST(DeltaCodec, an_empty_delta_takes_one_byte) { EXPECT_EQ(encode_delta({}).size(), 1u); }

TEST(DeltaCodec, lists_that_are_not_ascending_are_refused) {
  EXPECT_THROW(encode_delta({{2, 1}, {}}), Error);
  EXPECT_THROW(encode_delta({{}, {3, 3}}), Error);
}

TEST(DeltaCodec, a_count_that_the_bytes_cannot_hold_is_refused_early) {
  // 2²⁴ ids promised, then a few bytes: the decoder gives up where the bytes end.
  const std::array<uint8_t, 8> bytes = {0x80, 0x80, 0x80, 0x08, 0, 0, 0, 0};
  EXPECT_THROW(decode_delta(std::as_bytes(std::span(bytes)), "test"), Error);
  const std::array<uint8_t, 4> too_many = {0x81, 0x80, 0x80, 0x08};
  EXPECT_THROW(decode_delta(std::as_bytes(std::span(too_many)), "test"), Error);
}

TEST(DeltaCodec, every_truncation_and_every_changed_byte_is_refused_or_means_another_delta) {
  VisibleDelta delta;
  std::mt19937 random(1);
  for (DrawableId id = 3; id < 60'000; id += static_cast<DrawableId>(1 + random() % 900))
    (random() % 3 == 0 ? delta.removed : delta.added).push_back(id);
  const auto bytes = encode_delta(delta);
  const auto differs = [&](std::span<const std::byte> changed) {
    try {
      return decode_delta(changed, "test") != delta;
    } catch (const Error&) {
      return true;
    }
  };
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_TRUE(differs(std::span(bytes).first(length))) << length;
  }
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      auto changed = bytes;
      changed[i] ^= std::byte{1} << bit;
      EXPECT_TRUE(differs(changed)) << i;
    }
  }
}

// A walk as the cut sees it: 50,000 drawables, of which 2,000 are visible around a place that moves on. Scene
// nodes have four levels of detail, ids in a row; at the border nodes change their level, appear in groups of
// siblings, or vanish.
class Walk {
 public:
  VisibleSet frame(int i) const {
    VisibleSet visible;
    const double centre = 5000 + 3.0 * i;
    for (uint32_t node = 0; node < 12'500; ++node) {
      const double away = std::abs(node - centre);
      const double hidden = std::abs(std::sin(node / 4 * 12.9898) * 43758.5453);
      if (away > 2600 || hidden - std::floor(hidden) + 0.2 * std::sin(i * 0.05 + node / 4) < 0.6) continue;
      visible.push_back(4 * node + static_cast<uint32_t>(std::min(3.0, away / 650)));
    }
    return visible;
  }
};

TEST(DeltaCodec, a_walk_costs_far_less_than_the_papers_four_bytes_an_id) {
  const Walk walk;
  size_t ids = 0, bytes = 0;
  VisibleSet visible = walk.frame(0);
  for (int i = 1; i < 200; ++i) {
    const VisibleSet next = walk.frame(i);
    const VisibleDelta delta = difference(visible, next);
    ids += delta.size();
    bytes += encode_delta(delta).size();
    visible = next;
  }
  const double bytes_per_id = static_cast<double>(bytes) / static_cast<double>(ids);
  RecordProperty("ids_per_frame", static_cast<int>(ids / 199));
  RecordProperty("bytes_per_id", std::to_string(bytes_per_id));
  EXPECT_GT(ids / 199, 20u);
  EXPECT_LT(bytes_per_id, 1.5);
}

}  // namespace
}  // namespace triptych
