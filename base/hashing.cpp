#include "base/hashing.hpp"

#include "base/descriptor.hpp"
#include "base/error.hpp"

#include <algorithm>
#include <new>
#include <vector>
#include <xxhash.h>

namespace triptych {

uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

StreamHash::StreamHash() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_64bits_reset(state_);
}

StreamHash::~StreamHash() { XXH3_freeState(state_); }

void StreamHash::add(std::span<const std::byte> bytes) {
  XXH3_64bits_update(state_, bytes.data(), bytes.size());
}

uint64_t StreamHash::checksum() const { return XXH3_64bits_digest(state_); }

void StreamHash::add_kept(int descriptor, const KeptBytes& kept, const std::string& place) {
  if (size_of(descriptor, place) < kept.size)
    fail(place, "does not hold the {} bytes that were kept in it", kept.size);
  constexpr uint64_t stretch = 1 << 20;
  std::vector<std::byte> bytes;
  for (uint64_t at = 0; at < kept.size; at += bytes.size()) {
    bytes.resize(std::min(stretch, kept.size - at));
    read_at(descriptor, at, bytes, place);
    add(bytes);
  }
  if (kept.size > 0 && checksum() != kept.checksum)
    fail(place, "was changed after the build that wrote it ended");
}

}  // namespace triptych
