// Chunks are read when they are requested, in the thread that requests them.
#pragma once

#include "residency/residency.hpp"
#include "scene/pack.hpp"

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace triptych {

/// Reads requested chunks out of the pack, which must outlive it, and keeps them until they are evicted.
class LoadOnDemand final : public Residency {
 public:
  explicit LoadOnDemand(const Pack& pack) : pack_(pack) {}

  void request(uint32_t chunk, float priority) override;
  size_t pump(double budget_ms) override;
  const Chunk* pin(uint32_t chunk) override;
  void unpin(uint32_t chunk) override;
  void evict(uint32_t chunk) override;
  uint64_t memory_bytes() const override { return bytes_; }

 private:
  struct Request {
    float priority;
    uint64_t number;  ///< counts the requests
    uint32_t chunk;
    bool operator<(const Request& other) const {
      return priority != other.priority ? priority < other.priority : number > other.number;
    }
  };
  struct Resident {
    Chunk chunk;
    uint32_t pins = 0;
  };

  const Pack& pack_;
  std::vector<Request> requests_;  ///< a heap: the next one on top
  uint64_t request_count_ = 0;
  std::unordered_map<uint32_t, Resident> resident_;
  uint64_t bytes_ = 0;
};

}  // namespace triptych
