#include "residency/read_ahead.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {
uint64_t bytes_of(const Chunk& chunk) {
  return sizeof(Chunk) + chunk.vertices.capacity() * sizeof(ChunkVertex) +
         chunk.colors.capacity() * sizeof(VertexColor) + chunk.indices.capacity() * sizeof(uint32_t) +
         chunk.outward_runs.capacity() * sizeof(uint32_t);
}
}  // namespace

ReadAhead::ReadAhead(const Pack& pack, size_t threads, uint64_t held_bytes)
    : pack_(pack), held_bytes_(held_bytes) {
  for (size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

ReadAhead::~ReadAhead() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  expected_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ReadAhead::expect(uint32_t chunk, float priority) {
  {
    const std::lock_guard lock(mutex_);
    const auto [found, is_new] = entries_.try_emplace(chunk);
    Entry& entry = found->second;
    entry.frame = frame_;
    if (!is_new && (entry.state != State::waiting || entry.priority >= priority)) return;
    if (!is_new) waiting_.erase(order_of(entry, chunk));
    entry.priority = priority;
    entry.number = count_++;
    waiting_.insert(order_of(entry, chunk));
  }
  expected_.notify_one();
}

void ReadAhead::next_frame() {
  {
    const std::lock_guard lock(mutex_);
    ++frame_;
    for (const Order& order : waiting_) entries_.erase(std::get<uint32_t>(order));
    waiting_.clear();
    constexpr uint64_t patience = 1;  // frames
    for (auto next = ready_.begin(); next != ready_.end();) {
      const Order order = *next++;
      if (entries_.at(std::get<uint32_t>(order)).frame + patience < frame_) drop(order);
    }
  }
  expected_.notify_all();
}

Chunk ReadAhead::take(uint32_t chunk) {
  std::unique_lock lock(mutex_);
  ++use_.taken;
  const auto found = entries_.find(chunk);
  if (found != entries_.end() && found->second.state != State::waiting) {
    // References into the map stay good while others come and go.
    Entry& entry = found->second;
    ++(entry.state == State::ready ? use_.in_time : use_.late);
    read_.wait(lock, [&] { return entry.state == State::ready; });
    return remove(chunk);
  }
  if (found != entries_.end()) {
    waiting_.erase(order_of(found->second, chunk));
    entries_.erase(found);
  }
  lock.unlock();
  return pack_.read_chunk(chunk);
}

std::optional<Chunk> ReadAhead::take_if_ready(uint32_t chunk) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(chunk);
    if (found != entries_.end() && found->second.state == State::ready) {
      ++use_.taken;
      ++use_.in_time;
      return remove(chunk);
    }
  }
  expect(chunk, urgent);
  return std::nullopt;
}

Chunk ReadAhead::remove(uint32_t chunk) {
  Entry& entry = entries_.at(chunk);
  use_.bytes -= entry.bytes;
  ready_.erase(order_of(entry, chunk));
  Chunk taken = std::move(entry.chunk);
  const std::exception_ptr damage = entry.damage;
  entries_.erase(chunk);
  expected_.notify_one();  // there is room again
  if (damage) std::rethrow_exception(damage);
  return taken;
}

void ReadAhead::drop(const Order& ready) {
  const auto found = entries_.find(std::get<uint32_t>(ready));
  use_.bytes -= found->second.bytes;
  entries_.erase(found);
  ready_.erase(ready);
  ++use_.dropped;
}

bool ReadAhead::make_room() {
  const auto is_urgent = [](const Order& order) { return -std::get<float>(order) >= urgent; };
  while (use_.bytes >= held_bytes_ && !ready_.empty()) {
    const Order least = *ready_.rbegin();
    if (!is_urgent(*waiting_.begin()) || is_urgent(least)) return false;
    drop(least);
  }
  return true;
}

void ReadAhead::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    expected_.wait(lock, [&] { return ends_ || (!waiting_.empty() && make_room()); });
    if (ends_) return;
    const uint32_t chunk = std::get<uint32_t>(*waiting_.begin());
    waiting_.erase(waiting_.begin());
    Entry& entry = entries_.at(chunk);
    entry.state = State::reading;
    lock.unlock();
    Chunk read;
    std::exception_ptr damage;
    try {
      read = pack_.read_chunk(chunk);
    } catch (...) {
      damage = std::current_exception();
    }
    lock.lock();
    entry.chunk = std::move(read);
    entry.damage = damage;
    entry.bytes = bytes_of(entry.chunk);
    entry.state = State::ready;
    ++use_.read_ahead;
    use_.bytes += entry.bytes;
    ready_.insert(order_of(entry, chunk));
    use_.peak_bytes = std::max(use_.peak_bytes, use_.bytes);
    read_.notify_all();
  }
}

std::unordered_set<uint32_t> ReadAhead::ready() const {
  const std::lock_guard lock(mutex_);
  std::unordered_set<uint32_t> chunks;
  for (const Order& order : ready_) {
    const uint32_t chunk = std::get<uint32_t>(order);
    if (!entries_.at(chunk).damage) chunks.insert(chunk);
  }
  return chunks;
}

ReadAheadUse ReadAhead::use() const {
  const std::lock_guard lock(mutex_);
  ReadAheadUse use = use_;
  use.open = entries_.size();
  return use;
}

}  // namespace triptych
