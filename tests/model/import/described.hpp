// What a model says of its objects, as texts to compare with.
#pragma once

#include "model/flatten.hpp"
#include "model/model.hpp"

#include <string>
#include <vector>

namespace triptych::test {

/// "path > name (type) guid G layer L storey S number N {set: name=value}", of each what there is.
inline std::string described(const Model& model, SourceObjectId id) {
  if (id == no_id) return "none";
  const SourceObjects& source = model.source_objects;
  const SourceObject& object = source.objects.at(id);
  const auto text = [&](uint32_t number) { return std::string(source.texts[number]); };
  std::string said = source.path_of(id);
  said += (said.empty() ? "" : " > ") + text(object.name);
  if (object.type != 0) said += " (" + text(object.type) + ")";
  if (object.guid != 0) said += " guid " + text(object.guid);
  if (object.layer != 0) said += " layer " + text(object.layer);
  if (object.storey != 0) said += " storey " + text(object.storey);
  if (object.number != 0) said += " number " + text(object.number);
  for (const uint32_t set : source.sets_of(id)) {
    said += " {" + text(source.sets[set].name) + ":";
    for (const SourceProperty& property : source.properties_of(set))
      said += " " + text(property.name) + "=" + text(property.value);
    said += "}";
  }
  return said;
}

/// Of each instance, those in groups too.
inline std::vector<std::string> described(const Model& model) {
  std::vector<std::string> said;
  for (const Instance& instance : flattened(model).instances)
    said.push_back(described(model, instance.object));
  return said;
}

}  // namespace triptych::test
