// The levels of textures in memory: each is read when a pixel first asks for it.
#pragma once

#include "residency/residency.hpp"
#include "scene/geometry_use.hpp"
#include "scene/skeleton.hpp"

#include <atomic>
#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

namespace triptych {

/// Threads may ask side by side. What a view has asked for stays until the next one; beyond their cap levels
/// go that were not asked for since, those first that were asked for longest ago.
class TextureLevels {
 public:
  TextureLevels(const Skeleton& skeleton, Residency& residency);

  /// Rows from top to bottom. Error (pack, texture) for damage, unless it is to be done without.
  const Texel* texels(uint32_t texture, uint32_t level) const {
    const Level& own = levels_[first_[texture] + level];
    if (own.view.load(std::memory_order_relaxed) != view_) own.view.store(view_, std::memory_order_relaxed);
    const Texel* const there = own.texels.load(std::memory_order_acquire);
    return there != nullptr ? there : load(texture, level);
  }
  const Texture& texture(uint32_t index) const { return skeleton_.textures[index]; }

  /// Nobody asks meanwhile.
  void begin_view();
  void set_cap(uint64_t bytes) { cap_ = bytes; }
  void set_missing(const MissingChunks& missing) { missing_ = missing; }
  uint64_t bytes() const { return bytes_; }
  /// Levels that were read so far.
  uint64_t loaded() const { return loaded_; }

 private:
  struct Level {
    mutable std::atomic<const Texel*> texels = nullptr;
    mutable std::atomic<uint64_t> view = 0;  ///< the last one that asked for it
    mutable std::vector<Texel> held;
  };
  const Texel* load(uint32_t texture, uint32_t level) const;

  const Skeleton& skeleton_;
  Residency& residency_;
  std::vector<uint32_t> first_;  ///< for each texture where its levels begin
  std::deque<Level> levels_;
  uint64_t view_ = 1, cap_ = no_cap;
  MissingChunks missing_;
  mutable std::mutex mutex_;
  mutable std::atomic<uint64_t> bytes_ = 0, loaded_ = 0;
};

}  // namespace triptych
