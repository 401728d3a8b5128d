// Results on placed parts and what stands around them, which an earlier build may have kept
// (base/build_cache.hpp): by the parts' geometry and where they are placed, whatever else the model holds.
#pragma once

#include "base/build_cache.hpp"
#include "base/record.hpp"
#include "preprocess/kept_pairs.hpp"
#include "preprocess/parts.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace triptych {

class PlacedCache {
 public:
  /// Without a cache (null) everything is made, and no geometry is read here. All must outlive it; parts that
  /// are added later have no keys.
  PlacedCache(BuildCache* cache, const Parts& parts, const SpoolFile& geometry);

  bool is_used() const { return cache_ != nullptr; }

  /// What the result is, and of which hierarchy's space: the first part of each key.
  void begin(ContentKeyWriter& key, std::string_view what, const PlacedParts& hierarchy) const;
  /// A part's geometry, and what is known of its mesh.
  void add_part(ContentKeyWriter& key, uint32_t part) const { key.write(keys_[part]); }
  /// The same, its transform and its box.
  void add(ContentKeyWriter& key, const PlacedParts& hierarchy, uint32_t placed) const;
  /// Both as one.
  ContentKey key_of(const PlacedParts& hierarchy, uint32_t placed) const;

  /// Where groups of consecutive placed parts end, in ascending order: of about 16, at most 64. Where what is
  /// placed changes in one place, the other groups stay the same.
  std::vector<uint32_t> group_ends(const PlacedParts& hierarchy) const;

  /// What `make` gives, or gave under the same key, which begins with `what`. Value: a record, or a vector.
  template <typename Value, typename Make>
  Value get(std::string_view what, const ContentKeyWriter& key, const Make& make) const {
    if (!cache_) return make();
    return record_of<Value>(cache_->get(what, key.key(), [&] { return record_bytes(make()); }),
                            "a build's cache");
  }

  /// Hands what is kept under the key, or nothing, to `make`, which tells what of it holds, and keeps what
  /// that gives. Only where there is a cache.
  template <typename Make>
  void renew(std::string_view what, const ContentKeyWriter& key, const Make& make) const {
    cache_->renew(what, key.key(), make);
  }

  /// Calls make(KeptPairs&), for pairs of so many placed parts from `first` on; what: they tell of them.
  /// keys: of all placed parts. Where there is no cache nothing is kept, and there need be no keys.
  template <typename Make>
  void with_pairs(std::string_view what, const PlacedParts& hierarchy, std::span<const ContentKey> keys,
                  size_t first, size_t count, const Make& make) const {
    if (!is_used()) {
      KeptPairs none;
      make(none);
      return;
    }
    ContentKeyWriter key;
    begin(key, what, hierarchy);
    for (const ContentKey& member : keys.subspan(first, count)) key.write(member);
    renew(what, key, [&](const std::vector<std::byte>& before) {
      KeptPairs pairs(before);
      make(pairs);
      return pairs.bytes();
    });
  }

 private:
  BuildCache* cache_;
  const Parts& parts_;
  std::vector<ContentKey> keys_;  ///< of parts
};

}  // namespace triptych
