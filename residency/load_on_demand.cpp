#include "residency/load_on_demand.hpp"

#include "base/clock.hpp"

#include <algorithm>
#include <cassert>

namespace triptych {

namespace {
uint64_t bytes_of(const Chunk& chunk) {
  return chunk.vertices.size() * sizeof(ChunkVertex) + chunk.colors.size() * sizeof(VertexColor) +
         chunk.indices.size() * sizeof(uint32_t);
}
}  // namespace

void LoadOnDemand::request(uint32_t chunk, float priority) {
  if (resident_.count(chunk) != 0) return;
  requests_.push_back({priority, request_count_++, chunk});
  std::push_heap(requests_.begin(), requests_.end());
}

size_t LoadOnDemand::pump(double budget_ms) {
  const Stopwatch stopwatch;
  while (!requests_.empty() && stopwatch.milliseconds() < budget_ms) {
    std::pop_heap(requests_.begin(), requests_.end());
    const uint32_t chunk = requests_.back().chunk;
    requests_.pop_back();
    if (resident_.count(chunk) != 0) continue;  // requested twice
    Chunk geometry = pack_.read_chunk(chunk);
    bytes_ += bytes_of(geometry);
    resident_.emplace(chunk, Resident{std::move(geometry)});
  }
  return requests_.size();
}

const Chunk* LoadOnDemand::pin(uint32_t chunk) {
  const auto found = resident_.find(chunk);
  if (found == resident_.end()) return nullptr;
  ++found->second.pins;
  return &found->second.chunk;
}

void LoadOnDemand::unpin(uint32_t chunk) {
  Resident& resident = resident_.at(chunk);
  assert(resident.pins > 0);
  --resident.pins;
}

void LoadOnDemand::evict(uint32_t chunk) {
  const auto found = resident_.find(chunk);
  if (found == resident_.end() || found->second.pins > 0) return;
  bytes_ -= bytes_of(found->second.chunk);
  resident_.erase(found);
}

}  // namespace triptych
