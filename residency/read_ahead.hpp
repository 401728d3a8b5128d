// Chunks are read by threads before they are taken.
#pragma once

#include "residency/residency.hpp"
#include "scene/pack.hpp"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace triptych {

/// How well it was known what would be taken.
struct ReadAheadUse {
  uint64_t read_ahead = 0;             ///< chunks that threads have read
  uint64_t in_time = 0;                ///< of those: were there before a picture lacked them, or none waited
  uint64_t late = 0;                   ///< of those: were being read then
  uint64_t taken = 0;                  ///< chunks, read ahead or not
  uint64_t foreseen_read = 0;          ///< of those that threads have read: before any picture lacked them
  uint64_t foreseen_taken = 0;         ///< of those: were taken
  uint64_t reads = 0;                  ///< of the pack, each of one chunk or of several
  uint64_t dropped = 0;                ///< read, and dropped since nobody expected them any more
  uint64_t bytes = 0, peak_bytes = 0;  ///< of what is read and not taken yet
  uint64_t open = 0;  ///< chunks that are expected, being read, or were read and not taken yet
};

/// Reads expected chunks out of the pack, which must outlive it, on threads of its own, until it holds about
/// so many bytes of them; then it goes on when some were taken or have gone.
class ReadAhead final : public Residency {
 public:
  ReadAhead(const Pack& pack, size_t threads, uint64_t held_bytes);
  ~ReadAhead() override;

  /// Does nothing if the chunk is expected already, or there.
  void expect(uint32_t chunk, float priority) override;
  /// Waits for a chunk that is being read; reads one itself that is not, and with it what is expected beside
  /// it in the pack, where the pack's source likes that (ByteSource::Habits).
  Chunk take(uint32_t chunk) override;
  std::optional<Chunk> take_if_ready(uint32_t chunk) override;
  std::vector<Texel> read_texels(uint32_t texture, uint32_t level) override;
  /// What was expected and is not being read yet is expected no longer: the camera may go elsewhere. What was
  /// read and was not expected in the last frame goes.
  void next_frame();

  /// Chunks that are read and not taken.
  std::unordered_set<uint32_t> ready() const;
  /// Chunks that could not be read and that nobody has taken, each with why.
  std::unordered_map<uint32_t, std::string> unreadable() const;
  ReadAheadUse use() const;

 private:
  enum class State : uint8_t { waiting, reading, ready };
  struct Entry {
    State state = State::waiting;
    float priority = 0;
    uint64_t frame = 0;     ///< the last one that expected it
    uint64_t number = 0;    ///< counts what was expected
    bool foreseen = false;  ///< before a picture lacked it
    Chunk chunk = {};
    uint64_t bytes = 0;
    std::exception_ptr damage = {};  ///< thrown by whoever takes it
  };
  /// The next one first.
  using Order = std::tuple<float, uint64_t, uint32_t>;
  static Order order_of(const Entry& entry, uint32_t chunk) { return {-entry.priority, entry.number, chunk}; }
  /// What is read together with a chunk that waits, in the pack's order; none of it waits any more.
  std::vector<uint32_t> begin_run(uint32_t chunk);
  bool joins_run(uint32_t chunk) const;
  /// Reads them, while the lock is open. Then they are ready.
  void read_run(std::unique_lock<std::mutex>& lock, const std::vector<uint32_t>& run);
  /// Of an entry that is ready; it is gone then.
  Chunk remove(uint32_t chunk);
  /// Makes room for what is urgent, at the cost of what is not. False where there is none.
  bool make_room();
  void drop(const Order& ready);
  void work();

  const Pack& pack_;
  const uint64_t held_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable expected_, read_;
  std::unordered_map<uint32_t, Entry> entries_;
  std::set<Order> waiting_;
  std::set<Order> ready_;
  uint64_t count_ = 0, frame_ = 0;
  ReadAheadUse use_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace triptych
