// Deltas come back as they were, take few bytes, and no bytes make the decoder do harm.
#include "protocol/delta_codec.hpp"

#include "base/error.hpp"
#include "protocol/digest.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <rapidcheck/gtest.h>
#include <set>

namespace triptych {
namespace {

using Ids = std::set<DrawableId>;

VisibleSet in_order(const Ids& ids) { return {ids.begin(), ids.end()}; }

bool comes_back(const VisibleSet& before, const VisibleDelta& delta) {
  const auto bytes = encode_delta(delta, before);
  const DeltaCounts counts = delta_counts(bytes);
  return decode_delta(bytes, before, "test") == delta && counts.added == delta.added.size() &&
         counts.removed == delta.removed.size();
}

RC_GTEST_PROP(DeltaCodec, the_change_from_any_set_to_any_other_comes_back, (Ids before, Ids after)) {
  const VisibleSet set = in_order(before);
  RC_ASSERT(comes_back(set, difference(set, in_order(after))));
}

RC_GTEST_PROP(DeltaCodec, changes_of_crowded_sets_come_back, ()) {
  const auto crowd = rc::gen::container<Ids>(rc::gen::inRange<DrawableId>(0, 400));
  const auto base = *rc::gen::element<DrawableId>(0, 1000, no_id - 400);
  const auto shifted = [&](const Ids& ids) {
    VisibleSet set = in_order(ids);
    for (DrawableId& id : set) id += base;
    return set;
  };
  const VisibleSet before = shifted(*crowd);
  RC_ASSERT(comes_back(before, difference(before, shifted(*crowd))));
}

/// Runs of ids and single ones, up to the last id that there is.
Ids some_runs() {
  Ids ids;
  for (int runs = *rc::gen::inRange(0, 8); runs > 0; --runs) {
    const auto first = *rc::gen::oneOf(rc::gen::arbitrary<DrawableId>(), rc::gen::inRange<DrawableId>(0, 200),
                                       rc::gen::inRange<DrawableId>(no_id - 40, no_id));
    const auto length = *rc::gen::element<DrawableId>(1, 2, 33, 64);
    for (DrawableId i = 0; i < std::min(length, no_id - first + 1); ++i) ids.insert(first + i);
  }
  return ids;
}

RC_GTEST_PROP(DeltaCodec, changes_of_runs_come_back_also_to_nothing_to_all_and_to_the_same, ()) {
  const VisibleSet before = in_order(some_runs()), after = in_order(some_runs());
  for (const VisibleSet& from : {before, after, VisibleSet()}) {
    for (const VisibleSet& to : {before, after, VisibleSet()})
      RC_ASSERT(comes_back(from, difference(from, to)));
  }
}

RC_GTEST_PROP(DeltaCodec, what_is_cut_short_or_flipped_is_refused_or_told_by_the_digest, ()) {
  const VisibleSet before = in_order(some_runs()), after = in_order(some_runs());
  const auto bytes = encode_delta(difference(before, after), before);
  if (bytes.empty()) RC_DISCARD("nothing to damage");
  auto damaged = bytes;
  if (*rc::gen::arbitrary<bool>()) {
    damaged.resize(*rc::gen::inRange<size_t>(0, bytes.size()));
  } else {
    for (int flips = *rc::gen::inRange(1, 4); flips > 0; --flips) {
      const auto bit = *rc::gen::inRange<size_t>(0, 8 * bytes.size());
      damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    }
  }
  VisibleSet found = before;
  try {
    if (!apply_delta(decode_delta(damaged, before, "test"), found)) RC_SUCCEED("refused");
  } catch (const Error&) {
    RC_SUCCEED("refused");
  }
  const auto digest = [](const VisibleSet& set) { return frame_digest(3, {}, 7, set); };
  RC_ASSERT((digest(found) == digest(after)) == (found == after));
}

RC_GTEST_PROP(DeltaCodec, any_bytes_are_refused_or_are_the_one_encoding_of_a_delta,
              (std::vector<uint8_t> noise, Ids before)) {
  const auto bytes = std::as_bytes(std::span<const uint8_t>(noise));
  const VisibleSet set = in_order(before);
  try {
    const VisibleDelta delta = decode_delta(bytes, set, "test");
    RC_ASSERT(std::ranges::equal(encode_delta(delta, set), bytes));
  } catch (const Error&) {
    RC_SUCCEED("refused");
  }
}

TEST(DeltaCodec, the_ends_of_the_id_range_come_back) {
  EXPECT_TRUE(comes_back({}, {{0}, {}}));
  EXPECT_TRUE(comes_back({0}, {{}, {0}}));
  EXPECT_TRUE(comes_back({}, {{0xffffffff}, {}}));
  EXPECT_TRUE(comes_back({0xffffffff}, {{}, {0xffffffff}}));
  EXPECT_TRUE(comes_back({1, 0xfffffffe}, {{0, 0xffffffff}, {1, 0xfffffffe}}));
  EXPECT_TRUE(comes_back({5, 0x80000001}, {{0x7fffffff, 0x80000000}, {0x80000001}}));
}

TEST(DeltaCodec, an_id_on_both_lists_comes_back) { EXPECT_TRUE(comes_back({3, 5, 9}, {{5, 6}, {5}})); }

TEST(DeltaCodec, an_empty_delta_takes_no_byte) {
  EXPECT_TRUE(comes_back({1, 2, 3}, {}));
  EXPECT_TRUE(encode_delta({}, {1, 2, 3}).empty());
}

TEST(DeltaCodec, leaving_everything_behind_takes_few_bytes) {
  VisibleSet before(1'000'000);
  std::iota(before.begin(), before.end(), 7u);
  EXPECT_TRUE(comes_back(before, {{}, before}));
  EXPECT_LT(encode_delta({{}, before}, before).size(), 10u);
}

TEST(DeltaCodec, a_million_neighbours_take_few_bytes) {
  VisibleSet after(1'000'000);
  std::iota(after.begin(), after.end(), 7u);
  EXPECT_TRUE(comes_back({}, {after, {}}));
  EXPECT_LT(encode_delta({after, {}}, {}).size(), 10'000u);
}

TEST(DeltaCodec, deltas_that_no_set_can_take_are_refused) {
  EXPECT_THROW(encode_delta({{2, 1}, {}}, {}), Error);
  EXPECT_THROW(encode_delta({{}, {3, 3}}, {3}), Error);
  EXPECT_THROW(encode_delta({{}, {4}}, {3}), Error);
}

TEST(DeltaCodec, bytes_for_another_set_are_refused_or_mean_another_delta) {
  const VisibleSet set = {10, 20, 30, 40, 50};
  const VisibleDelta delta{{11, 12}, {10, 20, 30}};
  const auto bytes = encode_delta(delta, set);
  EXPECT_THROW(decode_delta(bytes, {10, 20}, "test"), Error);
  const VisibleSet other = {10, 21, 30, 40, 50};
  try {
    EXPECT_NE(decode_delta(bytes, other, "test"), delta);
  } catch (const Error&) {
  }
}

TEST(DeltaCodec, a_count_that_the_bytes_cannot_hold_is_refused_where_they_end) {
  for (const int first : {0x7f, 0x3f, 0xff, 0xfe}) {
    const std::vector<std::byte> bytes = {static_cast<std::byte>(first), std::byte{0xff}, std::byte{0xff},
                                          std::byte{0x7f}};
    EXPECT_THROW(decode_delta(bytes, {1, 2, 3}, "test"), Error) << first;
  }
}

/// The visible sets of a walk: 50,000 drawables, some 600 of them seen around a place that moves on. Each
/// scene node has four levels of detail, with ids in a row; far ones are coarser, and groups of four siblings
/// come and go behind walls.
VisibleSet walk_frame(int frame) {
  VisibleSet visible;
  for (uint32_t node = 0; node < 12'500; ++node) {
    const double away = std::abs(node - (5000 + 3.0 * frame));
    const double random = std::abs(std::sin(node / 4 * 12.9898) * 43758.5453);
    const double wall = random - std::floor(random) + 0.2 * std::sin(frame * 0.02 + node / 4);
    if (away > 1000 || wall < 0.7) continue;
    visible.push_back(4 * node + static_cast<uint32_t>(std::min(3.0, away / 250)));
  }
  return visible;
}

TEST(DeltaCodec, a_walk_costs_far_less_than_the_papers_four_bytes_an_id) {
  size_t ids = 0, bytes = 0;
  VisibleSet visible = walk_frame(0);
  for (int frame = 1; frame < 200; ++frame) {
    const VisibleSet next = walk_frame(frame);
    const VisibleDelta delta = difference(visible, next);
    ids += delta.size();
    bytes += encode_delta(delta, visible).size();
    visible = next;
  }
  const double bytes_per_id = static_cast<double>(bytes) / static_cast<double>(ids);
  RecordProperty("visible", static_cast<int>(visible.size()));
  RecordProperty("ids_per_frame", static_cast<int>(ids / 199));
  RecordProperty("bytes_per_id", std::to_string(bytes_per_id));
  EXPECT_GT(ids / 199, 5u);
  EXPECT_LT(bytes_per_id, 1.3);
}

TEST(DeltaCodec, single_changes_far_apart_cost_less_than_two_bytes_an_id) {
  VisibleSet before;
  for (DrawableId id = 100; id < 16'000; id += 150) before.push_back(id);
  const VisibleDelta delta{{3001, 9007}, {5950}};
  EXPECT_TRUE(comes_back(before, delta));
  EXPECT_LE(encode_delta(delta, before).size(), 6u);
}

TEST(DeltaCodec, every_truncation_and_every_changed_byte_is_refused_or_means_another_delta) {
  const VisibleSet before = walk_frame(0);
  const VisibleDelta delta = difference(before, walk_frame(40));
  const auto bytes = encode_delta(delta, before);
  const auto differs = [&](std::span<const std::byte> changed) {
    try {
      return decode_delta(changed, before, "test") != delta;
    } catch (const Error&) {
      return true;
    }
  };
  for (size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_TRUE(differs(std::span(bytes).first(length))) << length;
  }
  for (size_t bit = 0; bit < 8 * bytes.size(); ++bit) {
    auto changed = bytes;
    changed[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_TRUE(differs(changed)) << bit;
  }
}

}  // namespace
}  // namespace triptych
