#include "residency/chunk_cache.hpp"

#include <algorithm>

namespace triptych {

void ChunkCache::begin_view() {
  ++view_;
  use_.view_bytes = 0;
}

uint32_t ChunkCache::least_recently_used() const {
  return oldest_ != none && entries_[oldest_].view != view_ ? oldest_ : none;
}

uint32_t ChunkCache::next_to_go(uint64_t bytes) const {
  if (use_.bytes + bytes <= use_.cap) return none;
  const uint32_t chunk = least_recently_used();
  if (chunk == none) throw NoRoom(use_.view_bytes + bytes, use_.cap);
  return chunk;
}

void ChunkCache::add(uint32_t chunk, uint64_t bytes, uint64_t read_bytes, double wait_ms) {
  Entry& entry = entries_[chunk];
  entry.bytes = bytes;
  entry.view = view_;
  use_.reloaded_chunks += entry.was_here;
  entry.was_here = true;
  link_front(chunk);
  use_.bytes += bytes;
  use_.view_bytes += bytes;
  use_.peak_bytes = std::max(use_.peak_bytes, use_.bytes);
  ++use_.loaded_chunks;
  use_.read_bytes += read_bytes;
  use_.uploaded_bytes += bytes;
  use_.wait_ms += wait_ms;
}

void ChunkCache::remove(uint32_t chunk) {
  unlink(chunk);
  use_.bytes -= entries_[chunk].bytes;
  entries_[chunk].bytes = 0;
  ++use_.evicted_chunks;
}

void ChunkCache::move_to_front(uint32_t chunk) {
  entries_[chunk].view = view_;
  ++use_.hits;
  use_.view_bytes += entries_[chunk].bytes;
  if (chunk == newest_) return;
  unlink(chunk);
  link_front(chunk);
}

void ChunkCache::link_front(uint32_t chunk) {
  entries_[chunk].newer = none;
  entries_[chunk].older = newest_;
  if (newest_ != none) entries_[newest_].newer = chunk;
  newest_ = chunk;
  if (oldest_ == none) oldest_ = chunk;
}

void ChunkCache::unlink(uint32_t chunk) {
  const Entry& entry = entries_[chunk];
  (entry.newer != none ? entries_[entry.newer].older : newest_) = entry.older;
  (entry.older != none ? entries_[entry.older].newer : oldest_) = entry.newer;
}

}  // namespace triptych
