// A search in the window: a word that is typed, the objects that it finds, and which of them is looked at.
#pragma once

#include "scene/object_words.hpp"
#include "scene/pack_objects.hpp"
#include "view/overlay.hpp"

#include <optional>
#include <string>
#include <vector>

namespace triptych {

class Search {
 public:
  /// The objects must outlive it.
  explicit Search(const PackObjects& objects) : objects_(objects), finder_(objects.source()) {}

  /// Letters as they were typed, UTF-8.
  void type(std::string_view letters);
  /// Takes the last letter back.
  void erase();
  /// Goes on to the next object, or back to the one before, round and round. Nullopt where none is found.
  std::optional<SourceObjectId> step(bool back);

  const std::string& word() const { return word_; }
  const std::vector<SourceObjectId>& found() const { return found_; }
  /// "search WORD: 3 of 12 objects".
  std::string title() const;
  /// What there is to show of it, line by line.
  std::vector<Words> words() const;

 private:
  void find();
  std::string count() const;  ///< "12 objects", or which of them
  std::string name_of(SourceObjectId id) const;

  const PackObjects& objects_;
  ObjectFinder finder_;
  std::string word_;
  std::vector<SourceObjectId> found_;
  std::optional<size_t> at_;  ///< index into found_
};

}  // namespace triptych
