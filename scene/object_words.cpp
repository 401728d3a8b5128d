#include "scene/object_words.hpp"

#include "base/error.hpp"
#include "base/near_words.hpp"
#include "base/one_line.hpp"
#include "scene/file_objects.hpp"
#include "scene/object_text.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

namespace triptych {

namespace {

constexpr std::string_view file_kind = "file";

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& letter : lower) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return lower;
}

/// "layer:Walls": which text of an object is meant, and what it is, in lower case.
struct KindAndName {
  std::string kind;
  uint32_t SourceObject::*text;
  std::string name;
};

std::optional<KindAndName> kind_and_name(std::string_view word) {
  const size_t colon = word.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const std::string kind = lower_case(word.substr(0, colon)), name = lower_case(word.substr(colon + 1));
  if (kind == file_kind) return KindAndName{kind, &SourceObject::name, name};
  for (const ObjectText& member : object_texts) {
    if (kind == member.name) return KindAndName{kind, member.text, name};
  }
  return std::nullopt;
}

/// The objects that a kind is of.
std::vector<SourceObjectId> objects_of(const SourceObjects& source, const KindAndName& meant) {
  if (meant.kind == file_kind) return file_objects(source);
  std::vector<SourceObjectId> all(source.objects.size());
  for (SourceObjectId id = 0; id < all.size(); ++id) all[id] = id;
  return all;
}

std::vector<SourceObjectId> find_named(const SourceObjects& source, const KindAndName& meant) {
  std::vector<bool> is_it(source.texts.size());
  for (uint32_t i = 1; i < is_it.size(); ++i) is_it[i] = lower_case(source.texts[i]) == meant.name;
  std::vector<SourceObjectId> found = objects_of(source, meant);
  std::erase_if(found, [&](SourceObjectId id) { return !is_it[source.objects[id].*meant.text]; });
  return found;
}

/// What could have been meant, in lower case.
std::vector<std::string> known_words(const SourceObjects& source, const std::optional<KindAndName>& meant) {
  std::set<std::string> words;
  const auto add = [&](uint32_t text) {
    if (text != 0) words.insert((meant ? meant->kind + ":" : "") + lower_case(source.texts[text]));
  };
  if (meant) {
    for (const SourceObjectId id : objects_of(source, *meant)) add(source.objects[id].*meant->text);
  } else {
    for (const SourceObject& object : source.objects) {
      for (const ObjectText& member : object_texts) add(object.*member.text);
    }
  }
  return {words.begin(), words.end()};
}

}  // namespace

std::vector<SourceObjectId> find_objects(const SourceObjects& source, std::string_view word) {
  if (const auto meant = kind_and_name(word)) return find_named(source, *meant);
  const std::string wanted = lower_case(word);
  std::vector<bool> holds(source.texts.size());
  for (uint32_t i = 0; i < holds.size(); ++i)
    holds[i] = lower_case(source.texts[i]).find(wanted) != std::string::npos;
  std::vector<bool> set_holds(source.sets.size());
  for (uint32_t i = 0; i < set_holds.size(); ++i) {
    const auto properties = source.properties_of(i);
    set_holds[i] = std::any_of(properties.begin(), properties.end(),
                               [&](const SourceProperty& property) { return holds[property.value]; });
  }
  std::vector<SourceObjectId> found;
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    const auto sets = source.sets_of(id);
    if (std::any_of(object_texts.begin(), object_texts.end(),
                    [&](const ObjectText& member) { return holds[source.objects[id].*member.text]; }) ||
        std::any_of(sets.begin(), sets.end(), [&](uint32_t set) { return set_holds[set]; }))
      found.push_back(id);
  }
  return found;
}

std::vector<SourceObjectId> require_objects(const SourceObjects& source, const std::string& word,
                                            const std::string& place) {
  std::vector<SourceObjectId> found = find_objects(source, word);
  if (!found.empty()) return found;
  const std::string near = did_you_mean(lower_case(word), known_words(source, kind_and_name(word)));
  fail(place, "no object of {} is meant by \"{}\"{}", source.objects.size(), one_line(word), one_line(near));
}

}  // namespace triptych
