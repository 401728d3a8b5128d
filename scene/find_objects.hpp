// Objects by a word of what the model's files say of them.
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
  /// The objects of which a name, kind, GUID, layer, storey, number or property value holds the text,
  /// whatever the case of its ASCII letters, ascending; all of them for an empty text.
  std::vector<SourceObjectId> find(std::string_view text) const;

 private:
  const SourceObjects& source_;
  std::vector<std::string> texts_;  ///< in small letters
};

}  // namespace triptych
