// 64-bit checksums and digests: XXH3 (xxHash, Yann Collet).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

struct XXH3_state_s;

namespace triptych {

/// XXH3-64 of the bytes.
uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed = 0);

template <typename Value>
uint64_t hash_values(std::span<const Value> values, uint64_t seed = 0) {
  return hash_bytes(std::as_bytes(values), seed);
}

/// The checksum of bytes that come piece by piece: the same as hash_bytes() of all of them, seed 0.
class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;

  void add(std::span<const std::byte> bytes);
  uint64_t checksum() const;

 private:
  XXH3_state_s* state_;
};

}  // namespace triptych
