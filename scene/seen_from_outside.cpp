#include "scene/seen_from_outside.hpp"

#include "base/bytes.hpp"

#include <algorithm>

namespace triptych {

std::vector<std::byte> encode_seen_from_outside(const std::vector<bool>& by_chunk) {
  ByteWriter writer;
  writer.write(static_cast<uint64_t>(std::ranges::count(by_chunk, true)));
  for (uint32_t chunk = 0; chunk < by_chunk.size(); ++chunk) {
    if (by_chunk[chunk]) writer.write(chunk);
  }
  return std::move(writer.bytes());
}

std::vector<bool> decode_seen_from_outside(std::span<const std::byte> bytes, size_t chunks,
                                           const std::string& place) {
  ByteReader reader(bytes, place);
  std::vector<bool> by_chunk(chunks, false);
  const auto count = reader.read<uint64_t>();
  size_t least = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const size_t at = reader.offset();
    const auto chunk = reader.read<uint32_t>();
    if (chunk < least || chunk >= chunks)
      fail(place, "byte {}: chunk {} is not one of those that may follow", at, chunk);
    by_chunk[chunk] = true;
    least = size_t{chunk} + 1;
  }
  reader.expect_end();
  return by_chunk;
}

bool is_seen_from_outside(const Skeleton& skeleton, const Drawable& drawable) {
  if (skeleton.seen_from_outside.empty()) return false;
  const auto placements =
      std::span(skeleton.placements).subspan(drawable.first_placement, drawable.placement_count);
  return std::ranges::any_of(
      placements, [&](const Placement& placement) { return skeleton.seen_from_outside[placement.chunk]; });
}

}  // namespace triptych
