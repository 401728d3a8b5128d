// What something is made of, as 128 bits: equal content has equal keys, and no two others ever do in
// practice. XXH3-128 (xxHash, Yann Collet); not for content that somebody wants to collide.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

struct XXH3_state_s;

namespace triptych {

struct ContentKey {
  uint64_t low = 0, high = 0;
  auto operator<=>(const ContentKey&) const = default;
};
struct ContentKeyHash {
  size_t operator()(const ContentKey& key) const { return key.low; }
};

/// Takes content piece by piece; write_record() (base/record.hpp) can write to it.
class ContentKeyWriter {
 public:
  ContentKeyWriter();
  ~ContentKeyWriter();
  ContentKeyWriter(const ContentKeyWriter&) = delete;
  ContentKeyWriter& operator=(const ContentKeyWriter&) = delete;

  /// Values without padding.
  template <typename Value>
  void write_all(std::span<const Value> values) {
    add(std::as_bytes(values));
  }
  template <typename Value>
  void write(const Value& value) {
    add(std::as_bytes(std::span(&value, 1)));
  }
  ContentKey key() const;

 private:
  void add(std::span<const std::byte> bytes);

  XXH3_state_s* state_;
};

}  // namespace triptych
