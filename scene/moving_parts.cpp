#include "scene/moving_parts.hpp"

#include "scene/poses.hpp"

#include <algorithm>

namespace triptych {

namespace {
/// A frame under way, the one before, and one at rest.
constexpr size_t most_kept = 4;
}  // namespace

MovingParts::MovingParts() = default;
MovingParts::~MovingParts() = default;

std::shared_ptr<const Poses> MovingParts::poses_at(double time) const {
  const std::scoped_lock lock(mutex_);
  const auto use = [&](auto found) {
    std::rotate(found, found + 1, kept_.end());
    return kept_.back();
  };
  const auto same = std::ranges::find_if(kept_, [&](const auto& poses) { return poses->time() == time; });
  if (same != kept_.end()) return use(same);
  auto unused = kept_.end();
  if (kept_.size() >= most_kept)
    unused = std::ranges::find_if(kept_, [](const auto& poses) { return poses.use_count() == 1; });
  if (unused == kept_.end()) {
    kept_.push_back(std::make_shared<Poses>(*this));
    unused = kept_.end() - 1;
  }
  (*unused)->begin(time, ++begun_);
  return use(unused);
}

}  // namespace triptych
