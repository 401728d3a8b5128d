// What earlier builds found of pairs of placed parts, a group of pairs in one entry of the cache: each pair
// has its own key, so that a change of one side makes only the pairs again that it is in.
#pragma once

#include "base/content_key.hpp"
#include "base/record.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Pairs in the order in which they are asked for.
struct PairTable {
  std::vector<ContentKey> keys;
  std::vector<std::vector<std::byte>> values;  ///< records; empty where nothing was found
};
template <>
inline constexpr auto record_members<PairTable> = std::tuple(&PairTable::keys, &PairTable::values);

class KeptPairs {
 public:
  /// Keeps nothing: everything is made.
  KeptPairs() = default;
  /// before: what bytes() of an earlier build was; empty if there was none.
  explicit KeptPairs(const std::vector<std::byte>& before);

  /// What `make` gives, a vector, or gave for the same pair: of those with the numbers a and b, of which
  /// `keys` tell everything that `make` reads. Without a cache there need be no keys.
  template <typename Value, typename Make>
  std::vector<Value> get(std::span<const ContentKey> keys, uint32_t a, uint32_t b, const Make& make) {
    if (!is_used_) return make();
    const ContentKey pair = key_of(keys[a], keys[b]);
    if (const std::vector<std::byte>* known = find(pair)) {
      const std::vector<std::byte> bytes = *known;
      note(pair, bytes);
      if (bytes.empty()) return {};
      return record_of<std::vector<Value>>(bytes, "a build's cache");
    }
    std::vector<Value> made = make();
    note(pair, made.empty() ? std::vector<std::byte>() : record_bytes(made));
    return made;
  }

  /// What was asked for, for the next build.
  std::vector<std::byte> bytes() const { return record_bytes(now_); }

 private:
  static ContentKey key_of(const ContentKey& a, const ContentKey& b);
  const std::vector<std::byte>* find(const ContentKey& pair);
  void note(const ContentKey& pair, std::vector<std::byte> bytes);

  bool is_used_ = false;
  PairTable before_, now_;
  size_t next_ = 0;  ///< in before_: behind the pair that was found last
};

}  // namespace triptych
