// 64-bit checksums and digests: XXH3 (xxHash, Yann Collet).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

struct XXH3_state_s;

namespace triptych {

/// XXH3-64 of the bytes.
uint64_t hash_bytes(std::span<const std::byte> bytes, uint64_t seed = 0);

template <typename Value>
uint64_t hash_values(std::span<const Value> values, uint64_t seed = 0) {
  return hash_bytes(std::as_bytes(values), seed);
}

/// The beginning of a file that another process goes on with: how many bytes, and their checksum.
struct KeptBytes {
  uint64_t size = 0, checksum = 0;
};

/// The checksum of bytes that come a stretch at a time: the same as hash_bytes() of all of them, seed 0.
class StreamHash {
 public:
  StreamHash();
  ~StreamHash();
  StreamHash(const StreamHash&) = delete;
  StreamHash& operator=(const StreamHash&) = delete;

  void add(std::span<const std::byte> bytes);
  uint64_t checksum() const;
  /// Adds what stands at the beginning of a file. Error (place) unless it is what was kept.
  void add_kept(int descriptor, const KeptBytes& kept, const std::string& place);

 private:
  XXH3_state_s* state_;
};

}  // namespace triptych
