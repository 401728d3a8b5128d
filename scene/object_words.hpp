// Words by which people mean objects of a model's files.
#pragma once

#include "scene/source_objects.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace triptych {

/// What a word means, in any case of ASCII letters, ascending:
///   - `layer:NAME`, `storey:NAME`, `type:NAME`, `name:NAME`, `guid:GUID`, `number:NUMBER`: the objects of
///     which this is all of NAME; `file:NAME`: the object of a file of a model of several;
///   - any other word: the objects of which a name, kind, GUID, layer, storey, number or property value
///     holds it; all of them for an empty word.
std::vector<SourceObjectId> find_objects(const SourceObjects& source, std::string_view word);

/// The same for a word that has to mean something: Error (place), with the nearest word that does, where no
/// object is found.
std::vector<SourceObjectId> require_objects(const SourceObjects& source, const std::string& word,
                                            const std::string& place);

}  // namespace triptych
