#include "model/import/object_collector.hpp"

#include "base/error.hpp"

#include <limits>

namespace triptych {

ObjectCollector::ObjectCollector(SourceObjects& objects, std::string place)
    : objects_(objects), place_(std::move(place)), known_(0, Hash{&objects.texts}, Equal{&objects.texts}) {}

uint32_t ObjectCollector::number_of(std::string_view text) {
  if (text.empty()) return 0;
  if (const auto found = known_.find(text); found != known_.end()) return *found;
  if (objects_.texts.bytes() + text.size() > TextTable::max_bytes)
    fail(place_, "its names and properties are more than {} MiB of text", TextTable::max_bytes >> 20);
  const uint32_t number = objects_.texts.add(text);
  known_.insert(number);
  return number;
}

SourceObjectId ObjectCollector::add(const ObjectTexts& texts, SourceObjectId parent,
                                    std::span<const uint32_t> property_sets) {
  if (objects_.objects.size() >= no_id - 1) fail(place_, "holds too many objects");
  objects_.objects.push_back({.name = number_of(texts.name),
                              .type = number_of(texts.type),
                              .guid = number_of(texts.guid),
                              .layer = number_of(texts.layer),
                              .storey = number_of(texts.storey),
                              .number = number_of(texts.number),
                              .parent = parent,
                              .first_set = static_cast<uint32_t>(objects_.set_uses.size())});
  objects_.set_uses.insert(objects_.set_uses.end(), property_sets.begin(), property_sets.end());
  return static_cast<SourceObjectId>(objects_.objects.size() - 1);
}

uint32_t ObjectCollector::add_set(std::string_view name,
                                  std::span<const std::pair<std::string, std::string>> properties) {
  objects_.sets.push_back({number_of(name), static_cast<uint32_t>(objects_.properties.size())});
  for (const auto& [key, value] : properties)
    objects_.properties.push_back({number_of(key), number_of(value)});
  return static_cast<uint32_t>(objects_.sets.size() - 1);
}

}  // namespace triptych
