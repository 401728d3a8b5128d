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

/// The objects that a kind is of.
std::vector<SourceObjectId> objects_of(const SourceObjects& source, std::string_view kind) {
  if (kind == file_kind) return file_objects(source);
  std::vector<SourceObjectId> all(source.objects.size());
  for (SourceObjectId id = 0; id < all.size(); ++id) all[id] = id;
  return all;
}

}  // namespace

/// "layer:Walls": which text of an object is meant, and what it is, in small letters.
struct ObjectFinder::KindAndName {
  static std::optional<KindAndName> of(std::string_view word) {
    const size_t colon = word.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const std::string kind = lower_case(word.substr(0, colon)), name = lower_case(word.substr(colon + 1));
    if (kind == file_kind) return KindAndName{kind, &SourceObject::name, name};
    for (const ObjectText& member : object_texts) {
      if (kind == member.name) return KindAndName{kind, member.text, name};
    }
    return std::nullopt;
  }

  std::string kind;
  uint32_t SourceObject::*text;
  std::string name;
};

ObjectFinder::ObjectFinder(const SourceObjects& source) : source_(source) {
  texts_.reserve(source.texts.size());
  for (uint32_t i = 0; i < source.texts.size(); ++i) texts_.push_back(lower_case(source.texts[i]));
}

std::vector<SourceObjectId> ObjectFinder::find_named(const KindAndName& meant) const {
  std::vector<SourceObjectId> found = objects_of(source_, meant.kind);
  std::erase_if(found, [&](SourceObjectId id) {
    const uint32_t text = source_.objects[id].*meant.text;
    return text == 0 || texts_[text] != meant.name;
  });
  return found;
}

/// What could have been meant, in small letters.
std::vector<std::string> ObjectFinder::known_words(const KindAndName* meant) const {
  std::set<std::string> words;
  const auto add = [&](uint32_t text) {
    if (text != 0) words.insert((meant ? meant->kind + ":" : "") + texts_[text]);
  };
  if (meant) {
    for (const SourceObjectId id : objects_of(source_, meant->kind)) add(source_.objects[id].*meant->text);
  } else {
    for (const SourceObject& object : source_.objects) {
      for (const ObjectText& member : object_texts) add(object.*member.text);
    }
  }
  return {words.begin(), words.end()};
}

std::vector<SourceObjectId> ObjectFinder::find(std::string_view word) const {
  if (const auto meant = KindAndName::of(word)) return find_named(*meant);
  const std::string wanted = lower_case(word);
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

std::vector<SourceObjectId> ObjectFinder::require(const std::string& word, const std::string& place) const {
  if (word.find_first_not_of(" \t") == std::string::npos) fail(place, "an empty word means no object");
  if (source_.objects.empty()) fail(place, "\"{}\": the model's files name no objects", one_line(word));
  std::vector<SourceObjectId> found = find(word);
  if (!found.empty()) return found;
  const auto meant = KindAndName::of(word);
  const std::string near = did_you_mean(lower_case(word), known_words(meant ? &*meant : nullptr));
  fail(place, "no object of {} is meant by \"{}\"{}", source_.objects.size(), one_line(word), one_line(near));
}

}  // namespace triptych
