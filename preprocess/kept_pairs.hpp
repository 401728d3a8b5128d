// What earlier builds found of many small things, such as pairs of placed parts, a group of them in one entry
// of the cache: each has its own key, so that a change makes only those again that it concerns.
#pragma once

#include "base/content_key.hpp"
#include "base/record.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <tsl/robin_map.h>
#include <utility>
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

  bool is_used() const { return is_used_; }

  /// What `make` gives, a vector, or gave for the same pair: of those with the numbers a and b, of which
  /// `keys` tell everything that `make` reads. Without a cache there need be no keys.
  template <typename Value, typename Make>
  std::vector<Value> get(std::span<const ContentKey> keys, uint32_t a, uint32_t b, const Make& make) {
    return is_used_ ? get<Value>(key_of(keys[a], keys[b]), make) : make();
  }
  /// The same under a key of everything that `make` reads. Only where this is used.
  template <typename Value, typename Make>
  std::vector<Value> get(const ContentKey& key, const Make& make) {
    if (const std::vector<std::byte>* known = find(key)) {
      const std::vector<std::byte> bytes = *known;
      note(key, bytes);
      if (bytes.empty()) return {};
      return record_of<std::vector<Value>>(bytes, "a build's cache");
    }
    std::vector<Value> made = make();
    note(key, made.empty() ? std::vector<std::byte>() : record_bytes(made));
    return made;
  }

  /// What was asked for, for the next build.
  std::vector<std::byte> bytes() const { return record_bytes(now_); }

 private:
  static ContentKey key_of(const ContentKey& a, const ContentKey& b);
  const std::vector<std::byte>* find(const ContentKey& key);
  void note(const ContentKey& key, std::vector<std::byte> bytes);

  bool is_used_ = false;
  PairTable before_, now_;
  size_t next_ = 0;                                               ///< in before_: behind what was found last
  tsl::robin_map<ContentKey, size_t, ContentKeyHash> numbers_{};  ///< in before_; empty until it is needed
};

}  // namespace triptych
