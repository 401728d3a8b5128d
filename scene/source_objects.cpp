#include "scene/source_objects.hpp"

namespace triptych {

namespace {
/// From element `at`'s first one up to the next one's, or to the end.
template <typename Item, typename Owner, typename First>
std::span<const Item> range_of(const std::vector<Item>& items, const std::vector<Owner>& owners, size_t at,
                               First first) {
  const size_t begin = owners[at].*first;
  const size_t end = at + 1 < owners.size() ? owners[at + 1].*first : items.size();
  return std::span(items).subspan(begin, end - begin);
}
}  // namespace

uint32_t TextTable::add(std::string_view text) {
  bytes_ += text;
  ends_.push_back(static_cast<uint32_t>(bytes_.size()));
  return size() - 1;
}

std::span<const uint32_t> SourceObjects::sets_of(SourceObjectId object) const {
  return range_of(set_uses, objects, object, &SourceObject::first_set);
}

std::span<const SourceProperty> SourceObjects::properties_of(uint32_t set) const {
  return range_of(properties, sets, set, &SourcePropertySet::first_property);
}

std::string SourceObjects::path_of(SourceObjectId object) const {
  constexpr int most = 64;
  std::string path;
  int depth = 0;
  for (SourceObjectId at = objects[object].parent; at != no_id; at = objects[at].parent) {
    if (++depth > most) return "... / " + path;
    const std::string_view name = texts[objects[at].name];
    if (!name.empty()) path = std::string(name) + (path.empty() ? "" : " / ") + path;
  }
  return path;
}

}  // namespace triptych
