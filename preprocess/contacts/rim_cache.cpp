#include "preprocess/contacts/rim_cache.hpp"

namespace triptych {

std::shared_ptr<const PartRims> RimCache::find(uint32_t part) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(part);
  if (found == entries_.end()) return nullptr;
  recent_.splice(recent_.begin(), recent_, found->second.place);
  return found->second.rims;
}

std::shared_ptr<const PartRims> RimCache::get(uint32_t part) {
  if (auto known = find(part)) return known;
  const PartInfo& info = parts_.parts[part];
  auto rims =
      std::make_shared<const PartRims>(load<Part>(geometry_, info.place), parts_.lattices[info.lattice]);
  const std::lock_guard lock(mutex_);
  if (entries_.count(part) > 0) return rims;  // another thread read it meanwhile
  recent_.push_front(part);
  entries_[part] = {rims, recent_.begin()};
  bytes_left_ -= static_cast<int64_t>(rims->size());
  while (bytes_left_ < 0 && recent_.size() > 1) {
    const auto oldest = entries_.find(recent_.back());
    bytes_left_ += static_cast<int64_t>(oldest->second.rims->size());
    entries_.erase(oldest);
    recent_.pop_back();
  }
  return rims;
}

}  // namespace triptych
