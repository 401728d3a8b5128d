#include "scene/find_objects.hpp"

#include "scene/object_text.hpp"

#include <algorithm>
#include <cctype>

namespace triptych {

namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

}  // namespace

ObjectFinder::ObjectFinder(const SourceObjects& source) : source_(source) {
  texts_.reserve(source.texts.size());
  for (uint32_t i = 0; i < source.texts.size(); ++i) texts_.push_back(lower_case(source.texts[i]));
}

std::vector<SourceObjectId> ObjectFinder::find(std::string_view text) const {
  const std::string wanted = lower_case(text);
  std::vector<bool> holds(texts_.size());
  for (uint32_t i = 0; i < holds.size(); ++i) holds[i] = texts_[i].find(wanted) != std::string::npos;
  std::vector<bool> set_holds(source_.sets.size());
  for (uint32_t i = 0; i < set_holds.size(); ++i) {
    const auto properties = source_.properties_of(i);
    set_holds[i] = std::any_of(properties.begin(), properties.end(),
                               [&](const SourceProperty& property) { return holds[property.value]; });
  }
  std::vector<SourceObjectId> found;
  for (SourceObjectId id = 0; id < source_.objects.size(); ++id) {
    const auto sets = source_.sets_of(id);
    if (std::any_of(object_texts.begin(), object_texts.end(),
                    [&](const ObjectText& member) { return holds[source_.objects[id].*member.text]; }) ||
        std::any_of(sets.begin(), sets.end(), [&](uint32_t set) { return set_holds[set]; }))
      found.push_back(id);
  }
  return found;
}

}  // namespace triptych
