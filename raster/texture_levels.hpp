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

/// Threads may ask side by side. What a view has asked for stays until the next one. Beyond their cap those
/// levels go that were not asked for since, first those that were asked for longest ago; where what one view
/// asks for is more than the cap, its colours show coarser levels (fit()). Levels that say where holes are
/// are always the exact ones, since they decide about depth.
class TextureLevels {
 public:
  TextureLevels(const Skeleton& skeleton, Residency& residency);

  /// Rows from top to bottom. Error (pack, texture) for damage, unless it is to be done without.
  const Texel* texels(uint32_t texture, uint32_t level) const {
    const Texel* const there = find(texture, level);
    return there != nullptr ? there : load(texture, level, true);
  }
  /// The same for colours: null where the cap has no room, and the picture has to be made again.
  const Texel* texels_within_cap(uint32_t texture, uint32_t level) const {
    const Texel* const there = find(texture, level);
    return there != nullptr ? there : load(texture, level, false);
  }
  /// The finest level that colours show, where they ask for this one.
  uint32_t shown(uint32_t texture, uint32_t level) const {
    if (finest_.empty() || level >= finest_[texture]) return level;
    if (!shows_coarser_.load(std::memory_order_relaxed)) shows_coarser_ = true;
    return finest_[texture];
  }
  const Texture& texture(uint32_t index) const { return skeleton_.textures[index]; }

  /// Nobody asks meanwhile, as in all that follows.
  void begin_view();
  /// Whether all that the picture's colours asked for is within the cap. Otherwise what earlier views asked
  /// for goes, or colours show coarser levels from now on, and the picture has to be made again. The same for
  /// any number of threads.
  bool fit();
  void set_cap(uint64_t bytes) { cap_ = bytes; }
  void set_missing(const MissingChunks& missing) { missing_ = missing; }
  uint64_t bytes() const { return bytes_; }
  /// Levels that were read so far.
  uint64_t loaded() const { return loaded_; }
  TextureUse use() const;

 private:
  struct Level {
    mutable std::atomic<const Texel*> texels = nullptr;
    mutable std::atomic<uint64_t> view = 0;  ///< the last one that asked for it
    mutable std::vector<Texel> held;
  };
  const Texel* find(uint32_t texture, uint32_t level) const {
    const Level& own = levels_[first_[texture] + level];
    if (own.view.load(std::memory_order_relaxed) != view_) own.view.store(view_, std::memory_order_relaxed);
    return own.texels.load(std::memory_order_acquire);
  }
  const Texel* load(uint32_t texture, uint32_t level, bool always) const;
  void drop(Level& level);
  bool drop_older(uint64_t down_to);
  void show_from(uint32_t side);
  uint64_t bytes_of_view() const;
  uint64_t hits_of_view() const;

  const Skeleton& skeleton_;
  Residency& residency_;
  std::vector<uint32_t> first_;  ///< for each texture where its levels begin
  std::deque<Level> levels_;
  std::vector<uint32_t> finest_;  ///< of each texture the finest level that colours show; empty: 0 of all
  uint32_t largest_side_ = 1, shown_side_ = 1;  ///< of all levels, and of those that colours show
  uint64_t view_ = 1, cap_ = no_cap;
  MissingChunks missing_;
  TextureUse use_;
  mutable std::mutex mutex_;
  mutable std::atomic<uint64_t> bytes_ = 0, loaded_ = 0;
  mutable uint64_t loaded_in_view_ = 0, peak_bytes_ = 0, read_bytes_ = 0, decoded_bytes_ = 0;
  bool is_unbounded_ = false;  ///< the coarsest levels are too much: this view takes them all the same
  mutable std::atomic<bool> is_over_ = false, shows_coarser_ = false;
};

}  // namespace triptych
