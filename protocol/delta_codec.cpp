#include "protocol/delta_codec.hpp"

#include "base/bytes.hpp"
#include "protocol/range_coder.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace triptych {

namespace {

// One message's statistics. A gap is the distance to the id before (the first id: to 0) and is sent as its
// width in bits, then the bits below the highest. All of it depends on the kind of the id before and on how
// wide the gap before was: changes come in clusters, and a cluster is of one kind or alternates.
class DeltaModel {
 public:
  DeltaModel();
  BitModel& adjacent() { return adjacent_[context()]; }
  BitModel& width(uint32_t node) { return width_[node]; }
  BitModel& top(int width) { return top_[static_cast<size_t>(width)]; }
  BitModel& kind(int width) { return kind_[added_][static_cast<size_t>(std::min(width, 4))]; }
  void next(int width, bool added) {
    width_before_ = width;
    added_ = added;
  }

  static constexpr uint32_t leaves = 32;

 private:
  size_t context() const { return (width_before_ <= 1 ? 0u : width_before_ <= 4 ? 1u : 2u) + 3u * added_; }
  std::array<BitModel, 6> adjacent_;
  std::array<BitModel, leaves> width_;
  std::array<BitModel, 33> top_;
  std::array<std::array<BitModel, 5>, 2> kind_;
  int width_before_ = 32;
  size_t added_ = 1;
};

DeltaModel::DeltaModel() {
  // What widths are likely before any was seen: leaf 0 is the gap 0, leaf w − 1 the width w.
  std::array<double, 2 * leaves> weight{};
  for (uint32_t leaf = 0; leaf < leaves; ++leaf) {
    weight[leaves + leaf] = leaf == 0 ? 0.1 : leaf < 16 ? 16.0 : 0.5;
  }
  for (uint32_t node = leaves - 1; node > 0; --node) {
    weight[node] = weight[2 * node] + weight[2 * node + 1];
    width_[node] = BitModel(weight[2 * node] / weight[node], 2);
  }
}

// Encoder and decoder walk through the same model; `coder` gives or takes each bit.
struct Writer {
  RangeEncoder coder;
  bool bit(BitModel& model, bool value) {
    coder.encode(model, value);
    return value;
  }
  uint32_t even(uint32_t value, int count) {
    coder.encode_even(value, count);
    return value;
  }
};

struct Reader {
  RangeDecoder coder;
  bool bit(BitModel& model, bool) { return coder.decode(model); }
  uint32_t even(uint32_t, int count) { return coder.decode_even(count); }
};

template <typename Coder>
int code_width(Coder& coder, DeltaModel& model, int width) {
  if (coder.bit(model.adjacent(), width == 1)) return 1;
  const auto leaf = static_cast<uint32_t>(width == 0 ? 0 : width - 1);
  uint32_t node = 1;
  for (uint32_t half = DeltaModel::leaves / 2; half > 0; half /= 2) {
    node = 2 * node + coder.bit(model.width(node), (leaf & half) != 0);
  }
  const auto result = static_cast<int>(node - DeltaModel::leaves);
  return result == 0 ? 0 : result + 1;
}

template <typename Coder>
uint32_t code_gap(Coder& coder, DeltaModel& model, int width, uint32_t gap) {
  if (width < 2) return static_cast<uint32_t>(width);
  const int rest = width - 2;
  const uint32_t top = coder.bit(model.top(width), (gap >> rest & 1) != 0);
  const uint32_t low = coder.even(gap & ((1u << rest) - 1), rest);
  return 1u << (width - 1) | top << rest | low;
}

void check_list(const std::vector<DrawableId>& ids, const char* which, const std::string& place) {
  if (std::adjacent_find(ids.begin(), ids.end(), std::greater_equal<>()) != ids.end()) {
    fail(place, "the {} ids are not ascending", which);
  }
}

}  // namespace

std::vector<std::byte> encode_delta(const VisibleDelta& delta) {
  check_list(delta.added, "added", "delta");
  check_list(delta.removed, "removed", "delta");
  if (delta.size() > delta_limit) fail("delta", "{} ids do not fit into a message", delta.size());
  ByteWriter out;
  out.write_varint(delta.size());
  DeltaModel model;
  Writer writer;
  DrawableId before = 0;
  for (auto added = delta.added.begin(), removed = delta.removed.begin();
       added != delta.added.end() || removed != delta.removed.end();) {
    const bool is_added = removed == delta.removed.end() || (added != delta.added.end() && *added < *removed);
    const DrawableId id = is_added ? *added++ : *removed++;
    const uint32_t gap = id - before;
    const int width = std::bit_width(gap);
    code_width(writer, model, width);
    code_gap(writer, model, width, gap);
    writer.bit(model.kind(width), is_added);
    model.next(width, is_added);
    before = id;
  }
  out.write_all(std::span<const std::byte>(writer.coder.finish()));
  return std::move(out.bytes());
}

VisibleDelta decode_delta(std::span<const std::byte> bytes, const std::string& place) {
  ByteReader in(bytes, place);
  const uint64_t count = in.read_varint();
  if (count > delta_limit) fail(place, "a delta of {} ids", count);
  VisibleDelta delta;
  DeltaModel model;
  Reader reader{RangeDecoder(bytes.subspan(in.offset()))};
  uint64_t id = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const int width = code_width(reader, model, 0);
    id += code_gap(reader, model, width, 0);
    const bool added = reader.bit(model.kind(width), false);
    model.next(width, added);
    if (reader.coder.overran()) fail(place, "a delta that promises {} ids and ends after {}", count, i);
    if (id > no_id) fail(place, "a delta with an id beyond 32 bits");
    (added ? delta.added : delta.removed).push_back(static_cast<DrawableId>(id));
  }
  // There is one encoding of each delta, so anything else was not written by encode_delta.
  check_list(delta.added, "added", place);
  check_list(delta.removed, "removed", place);
  if (!std::ranges::equal(encode_delta(delta), bytes)) fail(place, "a delta in another encoding than ours");
  return delta;
}

}  // namespace triptych
