#include "raster/texture_levels.hpp"

#include "residency/take.hpp"

#include <algorithm>

namespace triptych {

TextureLevels::TextureLevels(const Skeleton& skeleton, Residency& residency)
    : skeleton_(skeleton), residency_(residency) {
  for (const Texture& texture : skeleton.textures) {
    first_.push_back(static_cast<uint32_t>(levels_.size()));
    for (size_t level = 0; level < texture.levels.size(); ++level) levels_.emplace_back();
  }
}

const Texel* TextureLevels::load(uint32_t texture, uint32_t level) const {
  const std::lock_guard lock(mutex_);
  const Level& own = levels_[first_[texture] + level];
  if (const Texel* const there = own.texels.load(std::memory_order_relaxed)) return there;
  own.held = take_texels(residency_, skeleton_.textures[texture], texture, level, missing_);
  bytes_ += own.held.size() * sizeof(Texel);
  ++loaded_;
  own.texels.store(own.held.data(), std::memory_order_release);
  return own.held.data();
}

void TextureLevels::begin_view() {
  if (bytes_ > cap_) {
    std::vector<Level*> old;
    for (Level& level : levels_)
      if (!level.held.empty() && level.view < view_) old.push_back(&level);
    std::ranges::stable_sort(old, {}, [](const Level* level) { return level->view.load(); });
    for (Level* const level : old) {
      if (bytes_ <= cap_) break;
      bytes_ -= level->held.size() * sizeof(Texel);
      level->texels = nullptr;
      level->held = {};
    }
  }
  ++view_;
}

}  // namespace triptych
