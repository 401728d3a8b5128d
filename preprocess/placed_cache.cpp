#include "preprocess/placed_cache.hpp"

#include "base/threads.hpp"

namespace triptych {

PlacedCache::PlacedCache(BuildCache* cache, const Parts& parts, const SpoolFile& geometry)
    : cache_(cache), parts_(parts), keys_(cache ? parts.parts.size() : 0) {
  parallel_for(keys_.size(), [&](size_t part) {
    const PartInfo& info = parts.parts[part];
    ContentKeyWriter key;
    key.write_all(std::span<const std::byte>(geometry.read(info.place)));
    key.write(parts.lattices[info.lattice].origin);
    key.write(parts.lattices[info.lattice].step);
    key.write(info.color);
    key.write(info.outside);
    key.write(info.transparent);
    keys_[part] = key.key();
  });
}

void PlacedCache::begin(ContentKeyWriter& key, std::string_view what, const PlacedParts& hierarchy) const {
  const Lattice& lattice = parts_.lattices[hierarchy.lattice];
  key.write(uint64_t{what.size()});
  key.write_all(std::span<const char>(what));
  key.write(lattice.origin);
  key.write(lattice.step);
}

void PlacedCache::add(ContentKeyWriter& key, const PlacedParts& hierarchy, uint32_t placed) const {
  const PlacedPart& of = hierarchy.placed[placed];
  add_part(key, of.part);
  key.write(hierarchy.transforms[of.transform]);
  key.write(hierarchy.boxes[placed]);
}

ContentKey PlacedCache::key_of(const PlacedParts& hierarchy, uint32_t placed) const {
  ContentKeyWriter key;
  add(key, hierarchy, placed);
  return key.key();
}

std::vector<uint32_t> PlacedCache::group_ends(const PlacedParts& hierarchy) const {
  constexpr uint32_t about = 16, most = 64;
  const auto count = static_cast<uint32_t>(hierarchy.placed.size());
  std::vector<uint32_t> ends;
  for (uint32_t i = 0, first = 0; i < count; ++i) {
    const uint32_t size = i + 1 - first;
    const bool ends_here = cache_ ? key_of(hierarchy, i).low % about == 0 || size == most : size == about;
    if (!ends_here && i + 1 < count) continue;
    ends.push_back(i + 1);
    first = i + 1;
  }
  return ends;
}

}  // namespace triptych
