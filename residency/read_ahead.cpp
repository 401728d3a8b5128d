#include "residency/read_ahead.hpp"

#include <algorithm>
#include <utility>

namespace triptych {

namespace {
uint64_t bytes_of(const Chunk& chunk) {
  return sizeof(Chunk) + chunk.vertices.capacity() * sizeof(ChunkVertex) +
         chunk.colors.capacity() * sizeof(VertexColor) + chunk.light.capacity() * sizeof(VertexLight) +
         chunk.normals.capacity() * sizeof(VertexNormal) + chunk.indices.capacity() * sizeof(uint32_t) +
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
    if (is_new) entry.foreseen = priority < urgent;
    if (entry.state == State::waiting && priority >= urgent) entry.foreseen = false;  // it comes too late
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
    if (entry.foreseen) ++(entry.state == State::ready ? use_.in_time : use_.late);
    read_.wait(lock, [&] { return entry.state == State::ready; });
    return remove(chunk);
  }
  const bool is_new = found == entries_.end();
  Entry& entry = entries_[chunk];
  if (is_new) waiting_.insert(order_of(entry, chunk));
  entry.foreseen = false;  // nobody had read it
  read_run(lock, begin_run(chunk));
  return remove(chunk);
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

std::vector<Texel> ReadAhead::read_texels(uint32_t texture, uint32_t level) {
  return pack_.read_texels(texture, level);
}

Chunk ReadAhead::remove(uint32_t chunk) {
  Entry& entry = entries_.at(chunk);
  use_.bytes -= entry.bytes;
  use_.foreseen_taken += entry.foreseen;
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

bool ReadAhead::joins_run(uint32_t chunk) const {
  const auto found = entries_.find(chunk);
  return found != entries_.end() && found->second.state == State::waiting;
}

std::vector<uint32_t> ReadAhead::begin_run(uint32_t chunk) {
  const ByteSource::Habits habits = pack_.source().habits();
  const std::vector<ChunkInfo>& chunks = pack_.skeleton().chunks;
  std::vector<uint32_t> run = {chunk};
  uint64_t begin = chunks[chunk].offset, end = begin + chunks[chunk].size;
  for (uint32_t next = chunk + 1; next < chunks.size() && habits.most_at_once > 0; ++next) {
    const ChunkInfo& info = chunks[next];
    if (info.offset < end || info.offset - end > habits.unasked ||
        info.offset + info.size - begin > habits.most_at_once)
      break;
    if (!joins_run(next)) continue;
    run.push_back(next);
    end = info.offset + info.size;
  }
  for (uint32_t next = chunk; next > 0 && habits.most_at_once > 0;) {
    const ChunkInfo& info = chunks[--next];
    const uint64_t info_end = info.offset + info.size;
    if (info_end > begin || begin - info_end > habits.unasked || end - info.offset > habits.most_at_once)
      break;
    if (!joins_run(next)) continue;
    run.push_back(next);
    begin = info.offset;
  }
  std::sort(run.begin(), run.end());
  for (const uint32_t each : run) {
    Entry& entry = entries_.at(each);
    waiting_.erase(order_of(entry, each));
    entry.state = State::reading;
  }
  return run;
}

void ReadAhead::read_run(std::unique_lock<std::mutex>& lock, const std::vector<uint32_t>& run) {
  lock.unlock();
  std::vector<Chunk> chunks(run.size());
  std::vector<std::exception_ptr> damage(run.size());
  try {
    const std::vector<std::byte> bytes = pack_.read_chunk_bytes(run.front(), run.back());
    for (size_t i = 0; i < run.size(); ++i) {
      try {
        chunks[i] = pack_.decode_chunk_in(bytes, run.front(), run[i]);
      } catch (...) {
        damage[i] = std::current_exception();
      }
    }
  } catch (...) {
    std::fill(damage.begin(), damage.end(), std::current_exception());
  }
  lock.lock();
  for (size_t i = 0; i < run.size(); ++i) {
    Entry& entry = entries_.at(run[i]);
    entry.chunk = std::move(chunks[i]);
    entry.damage = damage[i];
    entry.bytes = bytes_of(entry.chunk);
    entry.state = State::ready;
    use_.foreseen_read += entry.foreseen;
    use_.bytes += entry.bytes;
    ready_.insert(order_of(entry, run[i]));
  }
  ++use_.reads;
  use_.peak_bytes = std::max(use_.peak_bytes, use_.bytes);
  read_.notify_all();
}

void ReadAhead::work() {
  std::unique_lock lock(mutex_);
  for (;;) {
    expected_.wait(lock, [&] { return ends_ || (!waiting_.empty() && make_room()); });
    if (ends_) return;
    const std::vector<uint32_t> run = begin_run(std::get<uint32_t>(*waiting_.begin()));
    read_run(lock, run);
    use_.read_ahead += run.size();
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

std::unordered_map<uint32_t, std::string> ReadAhead::unreadable() const {
  const std::lock_guard lock(mutex_);
  std::unordered_map<uint32_t, std::string> chunks;
  for (const Order& order : ready_) {
    const uint32_t chunk = std::get<uint32_t>(order);
    const std::exception_ptr& damage = entries_.at(chunk).damage;
    if (!damage) continue;
    try {
      std::rethrow_exception(damage);
    } catch (const std::exception& error) {
      chunks[chunk] = error.what();
    }
  }
  return chunks;
}

ReadAheadUse ReadAhead::use() const {
  const std::lock_guard lock(mutex_);
  ReadAheadUse use = use_;
  use.open = static_cast<uint64_t>(
      std::ranges::count_if(entries_, [](const auto& entry) { return !entry.second.damage; }));
  return use;
}

}  // namespace triptych
