#include "base/content_key.hpp"

#include <new>
#include <xxhash.h>

namespace triptych {

ContentKeyWriter::ContentKeyWriter() : state_(XXH3_createState()) {
  if (!state_) throw std::bad_alloc();
  XXH3_128bits_reset(state_);
}

ContentKeyWriter::~ContentKeyWriter() { XXH3_freeState(state_); }

void ContentKeyWriter::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_, bytes.data(), bytes.size());
}

ContentKey ContentKeyWriter::key() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_);
  return {hash.low64, hash.high64};
}

}  // namespace triptych
