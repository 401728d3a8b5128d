// Something that is made of parts' geometry, read when it is asked for; what was used last stays in memory.
#pragma once

#include "preprocess/parts.hpp"

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace triptych {

/// Safe on several threads. Value: made of (const Part&, const Lattice&), and size() is about what it takes,
/// in bytes.
template <typename Value>
class PartCache {
 public:
  /// Reads the parts' geometry from the file, and keeps about so many bytes of values. Both must outlive it.
  PartCache(const Parts& parts, const SpoolFile& geometry, uint64_t bytes)
      : parts_(parts), geometry_(geometry), bytes_left_(static_cast<int64_t>(bytes)) {}

  /// Of a part, an index into Parts::parts.
  std::shared_ptr<const Value> get(uint32_t part) {
    if (auto known = find(part)) return known;
    const PartInfo& info = parts_.parts[part];
    auto made =
        std::make_shared<const Value>(load<Part>(geometry_, info.place), parts_.lattices[info.lattice]);
    const std::lock_guard lock(mutex_);
    if (entries_.count(part) > 0) return made;  // another thread read it meanwhile
    recent_.push_front(part);
    entries_[part] = {made, recent_.begin()};
    bytes_left_ -= static_cast<int64_t>(made->size());
    while (bytes_left_ < 0 && recent_.size() > 1) {
      const auto oldest = entries_.find(recent_.back());
      bytes_left_ += static_cast<int64_t>(oldest->second.value->size());
      entries_.erase(oldest);
      recent_.pop_back();
    }
    return made;
  }

 private:
  struct Entry {
    std::shared_ptr<const Value> value;
    std::list<uint32_t>::iterator place;
  };
  std::shared_ptr<const Value> find(uint32_t part) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(part);
    if (found == entries_.end()) return nullptr;
    recent_.splice(recent_.begin(), recent_, found->second.place);
    return found->second.value;
  }

  const Parts& parts_;
  const SpoolFile& geometry_;
  std::mutex mutex_;
  std::list<uint32_t> recent_;  ///< the last used one first
  std::unordered_map<uint32_t, Entry> entries_;
  int64_t bytes_left_;
};

}  // namespace triptych
