#include "view/search.hpp"

#include "scene/object_text.hpp"

#include <fmt/core.h>

namespace triptych {

void Search::type(std::string_view letters) {
  constexpr size_t longest = 100;
  if (word_.size() + letters.size() > longest) return;
  word_ += letters;
  find();
}

void Search::erase() {
  while (!word_.empty()) {
    const auto last = static_cast<unsigned char>(word_.back());
    word_.pop_back();
    if ((last & 0xc0) != 0x80) break;  // the first byte of the letter
  }
  find();
}

void Search::find() {
  found_ = word_.empty() ? std::vector<SourceObjectId>() : finder_.find(word_);
  at_.reset();
}

std::optional<SourceObjectId> Search::step(bool back) {
  if (found_.empty()) return std::nullopt;
  const size_t count = found_.size();
  if (!at_) {
    at_ = back ? count - 1 : 0;
  } else {
    at_ = (*at_ + (back ? count - 1 : 1)) % count;
  }
  return found_[*at_];
}

std::string Search::name_of(SourceObjectId id) const {
  const SourceObjects& source = objects_.source();
  const SourceObject& object = source.objects[id];
  std::string name;
  for (const uint32_t text : {object.type, object.name, object.storey}) {
    if (text != 0) name += (name.empty() ? "" : ", ") + in_one_cell(source.texts[text], 40);
  }
  return name.empty() ? fmt::format("object {}", id) : name;
}

std::string Search::count() const {
  const std::string objects = fmt::format("{} object{}", found_.size(), found_.size() == 1 ? "" : "s");
  return at_ ? fmt::format("{} of {}", *at_ + 1, objects) : objects;
}

std::string Search::title() const {
  return word_.empty() ? "search" : fmt::format("search {}: {}", in_one_cell(word_, 40), count());
}

std::vector<Words> Search::words() const {
  constexpr size_t most_names = 8;
  std::vector<Words> words = {{"find: " + word_ + "_"}};
  if (objects_.source().empty()) {
    words.push_back({"the model's files name no objects"});
    return words;
  }
  if (word_.empty()) {
    words.push_back({"a word of a name, kind, layer, storey, GUID, property"});
    return words;
  }
  words.push_back({count()});
  const size_t first = at_ && *at_ >= most_names / 2 ? *at_ - most_names / 2 : 0;
  for (size_t i = first; i < std::min(found_.size(), first + most_names); ++i) {
    const bool here = at_ && *at_ == i;
    words.push_back({(here ? "> " : "  ") + name_of(found_[i]), here ? selection_color : word_color});
  }
  if (!found_.empty()) words.push_back({"Enter: next  Shift+Enter: back  Ctrl+Enter: select all  Esc: done"});
  return words;
}

}  // namespace triptych
