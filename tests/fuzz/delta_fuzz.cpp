// The decoder of deltas: first byte the number of ids in the set before, a byte each for the gaps between
// them, then the encoded delta.
#include "base/error.hpp"
#include "fuzz_target.hpp"
#include "protocol/delta_codec.hpp"

#include <cstdlib>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace triptych;
  if (size == 0) return 0;
  std::span<const uint8_t> rest(data + 1, size - 1);
  VisibleSet before;
  const size_t count = std::min<size_t>(data[0], rest.size());
  DrawableId id = 0;
  for (const uint8_t gap : rest.first(count)) before.push_back(id += gap + 1u);
  const auto encoded = std::as_bytes(rest.subspan(count));
  try {
    const VisibleDelta delta = decode_delta(encoded, before, "delta");
    VisibleSet after = before;
    apply_delta(delta, after);  // it may not fit; the digest tells
    const auto again = encode_delta(delta, before);
    if (!std::equal(again.begin(), again.end(), encoded.begin(), encoded.end())) std::abort();
  } catch (const Error&) {
  }
  return 0;
}
