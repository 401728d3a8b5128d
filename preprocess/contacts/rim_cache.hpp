// The rims of parts, read when they are asked for; those that were used last stay in memory.
#pragma once

#include "preprocess/contacts/part_rims.hpp"
#include "preprocess/parts.hpp"

#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace triptych {

/// Safe on several threads.
class RimCache {
 public:
  /// Reads the parts' geometry from the file, and keeps about so many bytes of rims. Both must outlive it.
  RimCache(const Parts& parts, const SpoolFile& geometry, uint64_t bytes)
      : parts_(parts), geometry_(geometry), bytes_left_(static_cast<int64_t>(bytes)) {}

  /// Of a part, an index into Parts::parts.
  std::shared_ptr<const PartRims> get(uint32_t part);

 private:
  struct Entry {
    std::shared_ptr<const PartRims> rims;
    std::list<uint32_t>::iterator place;
  };
  std::shared_ptr<const PartRims> find(uint32_t part);

  const Parts& parts_;
  const SpoolFile& geometry_;
  std::mutex mutex_;
  std::list<uint32_t> recent_;  ///< the last used one first
  std::unordered_map<uint32_t, Entry> entries_;
  int64_t bytes_left_;
};

}  // namespace triptych
