#include "protocol/delta_codec.hpp"

#include "base/error.hpp"
#include "protocol/range_coder.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

namespace triptych {

namespace {

// Writer and Reader run through the same code: the former is given each bit, the latter returns it.
struct Writer {
  RangeEncoder coder;
  bool bit(BitModel& model, bool value) {
    coder.encode(model, value);
    return value;
  }
  uint32_t even(uint32_t value, int count) {
    coder.encode_even(value, count);
    return value & ((1u << count) - 1);
  }
  void check(const char*) const {}
};

struct Reader {
  RangeDecoder coder;
  const std::string& place;
  bool bit(BitModel& model, bool) { return coder.decode(model); }
  uint32_t even(uint32_t, int count) { return coder.decode_even(count); }
  void check(const char* what) const {
    if (coder.overran()) fail(place, "a delta that ends before {}", what);
  }
};

int width_of(uint64_t value) { return static_cast<int>(std::bit_width(value)); }

const int count_width = width_of(delta_limit);

/// A count: its width in bits, in unary, then the bits below the highest. Small counts take few bits.
template <typename Coder>
size_t code_count(Coder& coder, size_t count) {
  const int wanted = width_of(count);
  int width = 0;
  for (; width < count_width; ++width) {
    BitModel more;
    if (!coder.bit(more, wanted > width)) break;
  }
  if (width == 0) return 0;
  return size_t{1} << (width - 1) | coder.even(static_cast<uint32_t>(count), width - 1);
}

/// Which elements of `before` are removed: one bit each, up to the last removed one. `removed` is read or
/// appended to.
template <typename Coder>
void code_removed(Coder& coder, std::vector<DrawableId>& removed, size_t count, const VisibleSet& before) {
  const size_t kept = before.size() - count;
  // One model for the bit after a kept element, one for after a removed one, since changes come in clusters.
  std::array models = {BitModel(kept, before.size() + 1, 8),
                       BitModel(2 * kept + count, 3 * before.size() + 1, 2)};
  bool last = false;
  size_t done = 0;
  for (size_t i = 0; done < count && count - done < before.size() - i; ++i) {
    coder.check("its last removed id");
    const bool wanted = done < removed.size() && removed[done] == before[i];
    last = coder.bit(models[last], wanted);
    if (!last) continue;
    if (done++ == removed.size()) removed.push_back(before[i]);
  }
  // All remaining elements must be removed ones.
  const size_t rest = count - done;
  if (done == removed.size())
    removed.insert(removed.end(), before.end() - static_cast<std::ptrdiff_t>(rest), before.end());
}

/// Statistics of the gaps between added ids.
class GapModel {
 public:
  /// expected: a gap's likely width in bits.
  explicit GapModel(int expected) {
    std::array<uint32_t, 2 * leaves> weight{};
    for (int width = 0; width <= 32; ++width) {
      // Gaps between independent ids are around the expected width, seldom far above it; clusters add small
      // ones.
      static constexpr std::array<uint32_t, 4> above = {256, 192, 48, 4};
      const int over = width - expected;
      weight[leaves + leaf_of(width)] = over >= 0 ? above[static_cast<size_t>(std::min(over, 3))]
                                                  : std::max(256u >> std::min(-over, 8), 24u);
    }
    weight[leaves] = 1;
    for (uint32_t node = leaves - 1; node > 0; --node) {
      weight[node] = weight[2 * node] + weight[2 * node + 1];
      width_[node] = BitModel(weight[2 * node], weight[node], 4);
    }
    adjacent_.fill(BitModel(6, 7, 2));
    adjacent_[1] = BitModel(1, 2, 1);
  }

  template <typename Coder>
  uint32_t code(Coder& coder, uint32_t gap) {
    const int width = code_width(coder, width_of(gap));
    near_ = width <= 3 ? (width <= 1 ? 1u : 2u) : 0u;
    if (width < 2) return static_cast<uint32_t>(width);
    const int rest = width - 2;
    const uint32_t high = coder.bit(top_[static_cast<size_t>(width)], (gap >> rest & 1) != 0);
    return 1u << (width - 1) | high << rest | coder.even(gap, rest);
  }

 private:
  static constexpr uint32_t leaves = 32;
  static uint32_t leaf_of(int width) { return width < 2 ? 0 : static_cast<uint32_t>(width - 1); }

  template <typename Coder>
  int code_width(Coder& coder, int width) {
    if (coder.bit(adjacent_[near_], width == 1)) return 1;
    const uint32_t leaf = leaf_of(width);
    uint32_t node = 1;
    for (uint32_t half = leaves / 2; half > 0; half /= 2) {
      node = 2 * node + coder.bit(width_[node], (leaf & half) != 0);
    }
    return node == leaves ? 0 : static_cast<int>(node - leaves) + 1;
  }

  std::array<BitModel, 3> adjacent_;  ///< is the gap 1? After a wide gap, after 1, after a small one
  std::array<BitModel, leaves> width_;
  std::array<BitModel, 33> top_;
  uint32_t near_ = 0;
};

template <typename Coder>
void code_added(Coder& coder, std::vector<DrawableId>& added, size_t count, const VisibleSet& before) {
  const bool reading = added.empty();
  const uint64_t range = before.empty() ? uint64_t{1} << 16 : uint64_t{before.back()} + 1;
  GapModel gaps(width_of(range / (count + 1)));
  uint64_t id = 0;
  for (size_t i = 0; i < count; ++i) {
    const uint32_t gap = gaps.code(coder, reading ? 0 : added[i] - static_cast<uint32_t>(id));
    id += gap;
    coder.check("its last added id");
    if (!reading) continue;
    if (id > no_id || (gap == 0 && i > 0))
      id = no_id;  // not a valid delta: it fails the comparison with its own encoding
    added.push_back(static_cast<DrawableId>(id));
  }
}

template <typename Coder>
void code_delta(Coder& coder, VisibleDelta& delta, const DeltaCounts& counts, const VisibleSet& before) {
  if (counts.removed > 0) code_removed(coder, delta.removed, counts.removed, before);
  if (counts.added > 0) code_added(coder, delta.added, counts.added, before);
}

template <typename Coder>
DeltaCounts code_counts(Coder& coder, const DeltaCounts& counts) {
  const size_t removed = code_count(coder, counts.removed);
  return {code_count(coder, counts.added), removed};
}

bool is_ascending(const std::vector<DrawableId>& ids) {
  return std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) == ids.end();
}

}  // namespace

std::vector<std::byte> encode_delta(const VisibleDelta& delta, const VisibleSet& before) {
  if (!is_ascending(delta.added) || !is_ascending(delta.removed)) fail("delta", "the ids are not ascending");
  if (!std::ranges::includes(before, delta.removed)) fail("delta", "removes what is not in the set");
  const DeltaCounts counts{delta.added.size(), delta.removed.size()};
  if (std::max(counts.added, counts.removed) > delta_limit) {
    fail("delta", "{} ids do not fit into a message", delta.size());
  }
  Writer writer;
  code_counts(writer, counts);
  VisibleDelta copy = delta;
  code_delta(writer, copy, counts, before);
  return writer.coder.finish();
}

VisibleDelta decode_delta(std::span<const std::byte> bytes, const VisibleSet& before,
                          const std::string& place) {
  Reader reader{RangeDecoder(bytes), place};
  const DeltaCounts counts = code_counts(reader, {});
  if (counts.added > delta_limit) fail(place, "a delta that adds {} ids", counts.added);
  if (counts.removed > before.size()) {
    fail(place, "a delta that removes {} ids of a set of {}", counts.removed, before.size());
  }
  VisibleDelta delta;
  code_delta(reader, delta, counts, before);
  // There is one encoding of each delta, so anything else was not written by encode_delta.
  const bool canonical = is_ascending(delta.added) && std::ranges::equal(encode_delta(delta, before), bytes);
  if (!canonical) fail(place, "a delta in another encoding than ours");
  return delta;
}

DeltaCounts delta_counts(std::span<const std::byte> bytes) {
  const std::string nowhere;
  Reader reader{RangeDecoder(bytes), nowhere};
  return code_counts(reader, {});
}

}  // namespace triptych
