// Words by which people mean objects of a model's files.
#pragma once

#include "scene/source_objects.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// Makes all texts ready for searches, once. The objects must outlive it.
class ObjectFinder {
 public:
  explicit ObjectFinder(const SourceObjects& source);
  /// What a word means, in any case of ASCII letters, ascending:
  ///   - `layer:NAME`, `storey:NAME`, `type:NAME`, `name:NAME`, `guid:GUID`, `number:NUMBER`: the objects of
  ///     which this is all of NAME; `file:NAME`: the object of a file of a model of several;
  ///   - any other word: the objects of which a name, kind, GUID, layer, storey, number or property value
  ///     holds it; all of them for an empty word.
  std::vector<SourceObjectId> find(std::string_view word) const;
  /// The same for a word that has to mean something: Error (place), with the nearest word that does, where no
  /// object is found.
  std::vector<SourceObjectId> require(const std::string& word, const std::string& place) const;

 private:
  struct KindAndName;
  std::vector<SourceObjectId> find_named(const KindAndName& meant) const;
  std::vector<std::string> known_words(const KindAndName* meant) const;

  const SourceObjects& source_;
  std::vector<std::string> texts_;  ///< in small letters
};

}  // namespace triptych
