#include "raster/texture_levels.hpp"

#include "residency/take.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Below it nothing is saved.
constexpr uint32_t least_side = 4;

}  // namespace

TextureLevels::TextureLevels(const Skeleton& skeleton, Residency& residency)
    : skeleton_(skeleton), residency_(residency) {
  for (const Texture& texture : skeleton.textures) {
    first_.push_back(static_cast<uint32_t>(levels_.size()));
    for (size_t level = 0; level < texture.levels.size(); ++level) levels_.emplace_back();
    largest_side_ = std::max({largest_side_, texture.width, texture.height});
  }
  shown_side_ = largest_side_;
}

const Texel* TextureLevels::load(uint32_t texture, uint32_t level, bool always) const {
  const std::lock_guard lock(mutex_);
  const Level& own = levels_[first_[texture] + level];
  if (const Texel* const there = own.texels.load(std::memory_order_relaxed)) return there;
  const Texture& whole = skeleton_.textures[texture];
  const uint64_t bytes =
      uint64_t{side_at_level(whole.width, level)} * side_at_level(whole.height, level) * sizeof(Texel);
  if (bytes_ + bytes > cap_ && !always && !is_unbounded_) {
    is_over_ = true;
    return nullptr;
  }
  own.held = take_texels(residency_, whole, texture, level, missing_);
  bytes_ += bytes;
  peak_bytes_ = std::max<uint64_t>(peak_bytes_, bytes_);
  read_bytes_ += whole.levels[level].size;
  decoded_bytes_ += bytes;
  ++loaded_;
  ++loaded_in_view_;
  own.texels.store(own.held.data(), std::memory_order_release);
  return own.held.data();
}

void TextureLevels::drop(Level& level) {
  bytes_ -= level.held.size() * sizeof(Texel);
  level.texels = nullptr;
  level.held = {};
  ++use_.evicted;
}

/// Of what the view has not asked for, as much as it takes. Whether anything went.
bool TextureLevels::drop_older(uint64_t down_to) {
  if (bytes_ <= down_to) return false;
  std::vector<Level*> old;
  for (Level& level : levels_)
    if (!level.held.empty() && level.view < view_) old.push_back(&level);
  std::ranges::stable_sort(old, {}, [](const Level* level) { return level->view.load(); });
  for (Level* const level : old) {
    if (bytes_ <= down_to) break;
    drop(*level);
  }
  return !old.empty();
}

uint64_t TextureLevels::bytes_of_view() const {
  uint64_t bytes = 0;
  for (const Level& level : levels_)
    if (level.view == view_) bytes += level.held.size() * sizeof(Texel);
  return bytes;
}

uint64_t TextureLevels::hits_of_view() const {
  uint64_t asked = 0;
  for (const Level& level : levels_) asked += level.view == view_;
  return asked - std::min(asked, loaded_in_view_);
}

void TextureLevels::show_from(uint32_t side) {
  shown_side_ = std::min(side, largest_side_);
  finest_.clear();
  if (side >= largest_side_) return;
  for (const Texture& texture : skeleton_.textures) {
    uint32_t level = 0;
    while (std::max(side_at_level(texture.width, level), side_at_level(texture.height, level)) > side)
      ++level;
    finest_.push_back(level);
  }
}

void TextureLevels::begin_view() {
  if (levels_.empty()) return;
  use_.hits += hits_of_view();
  use_.coarser_views += shows_coarser_;
  use_.over_cap_views += bytes_of_view() > cap_;
  loaded_in_view_ = 0;
  is_over_ = shows_coarser_ = is_unbounded_ = false;
  // A level that is twice as large takes four times the bytes.
  if (!finest_.empty() && (cap_ == no_cap || 4 * bytes_of_view() <= cap_)) show_from(2 * shown_side_);
  if (cap_ != no_cap) drop_older(cap_ - cap_ / 4);  // what comes next has room
  ++view_;
}

bool TextureLevels::fit() {
  if (!is_over_) return true;
  is_over_ = false;
  if (drop_older(0)) return false;
  if (shown_side_ <= least_side) {  // all of it shows as little as it can
    is_unbounded_ = true;
    return false;
  }
  show_from(shown_side_ / 2);
  for (size_t texture = 0; texture < first_.size(); ++texture) {
    for (uint32_t level = 0; level < finest_[texture]; ++level) {
      Level& own = levels_[first_[texture] + level];
      own.view = 0;
      if (!own.held.empty()) drop(own);
    }
  }
  return false;
}

TextureUse TextureLevels::use() const {
  TextureUse use = use_;
  use.cap = cap_;
  use.bytes = bytes_;
  use.peak_bytes = peak_bytes_;
  use.hits += hits_of_view();
  use.coarser_views += shows_coarser_;
  use.over_cap_views += bytes_of_view() > cap_;
  use.misses = loaded_;
  use.read_bytes = read_bytes_;
  use.decoded_bytes = decoded_bytes_;
  return use;
}

}  // namespace triptych
