#include "base/hashing.hpp"

#include <new>
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

}  // namespace triptych
