// Which chunks a device has, within a cap: those that were not used for longest go first.
#pragma once

#include "scene/geometry_use.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace triptych {

/// Counts bytes of chunks, and says which are to go; what holds them is the device's. What the current view
/// uses stays.
class ChunkCache {
 public:
  explicit ChunkCache(size_t chunks) : entries_(chunks) {}

  /// From now on; where it is exceeded, next_to_go() says what goes.
  void set_cap(uint64_t bytes) { use_.cap = bytes; }
  /// What earlier views used may go from now on.
  void begin_view();
  bool has(uint32_t chunk) const { return entries_[chunk].bytes > 0; }
  /// The current view uses this chunk, which is there.
  void touch(uint32_t chunk) {
    if (entries_[chunk].view != view_) move_to_front(chunk);
  }

  static constexpr uint32_t none = 0xffffffffu;
  /// A chunk that has to go so that `bytes` more are within the cap; none if they are. NoRoom if all that is
  /// there is used by the current view.
  uint32_t next_to_go(uint64_t bytes) const;
  /// A chunk that may go, whatever the cap is; none if there is no such chunk.
  uint32_t least_recently_used() const;
  /// The chunk has come, and takes so many bytes (above 0); the current view uses it.
  void add(uint32_t chunk, uint64_t bytes, uint64_t read_bytes, double wait_ms);
  /// A draw had to do without a chunk.
  void leave_out(bool for_want_of_room) {
    ++use_.left_out;
    use_.no_room += for_want_of_room;
  }
  /// The chunk cannot be read: draws do without it from now on.
  void mark_damaged(uint32_t chunk) { entries_[chunk].damaged = true; }
  bool is_damaged(uint32_t chunk) const { return entries_[chunk].damaged; }
  /// The chunk is gone.
  void remove(uint32_t chunk);

  const GeometryUse& use() const { return use_; }

 private:
  struct Entry {
    uint64_t bytes = 0;  ///< 0: it is not there
    uint32_t view = 0;   ///< the last one that used it
    bool was_here = false, damaged = false;
    uint32_t newer = none, older = none;
  };
  void link_front(uint32_t chunk);
  void unlink(uint32_t chunk);
  void move_to_front(uint32_t chunk);

  std::vector<Entry> entries_;
  uint32_t newest_ = none, oldest_ = none;
  uint32_t view_ = 1;
  GeometryUse use_;
};

}  // namespace triptych
