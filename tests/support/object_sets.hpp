// Scenes whose every placement is an object, and sets of them to hide.
#pragma once

#include "model/model.hpp"
#include "scene/hidden_objects.hpp"
#include "tests/support/scenes.hpp"

#include <string>
#include <vector>

namespace triptych::test {

/// How many objects a group's ids count, those of its groups among them.
inline uint32_t objects_in(const Model& model, const Group& group) {
  auto count = static_cast<uint32_t>(group.instances.size());
  for (const GroupInstance& inner : group.groups) count += objects_in(model, model.groups[inner.group]);
  return count;
}

inline void name_objects(const Model& model, Group& group) {
  SourceObjectId next = 0;
  for (Instance& instance : group.instances) instance.object = next++;
  for (GroupInstance& inner : group.groups) {
    inner.first_object = next;
    next += objects_in(model, model.groups[inner.group]);
  }
}

/// Gives each placement of the model an object; every seventh lies in the one before it, and layers, storeys
/// and types repeat.
inline Model with_objects(Model model) {
  for (Group& group : model.groups) name_objects(model, group);
  SourceObjectId count = 0;
  for (Instance& instance : model.instances) instance.object = count++;
  for (GroupInstance& placed : model.group_instances) {
    placed.first_object = count;
    count += objects_in(model, model.groups[placed.group]);
  }
  SourceObjects source;
  const auto text = [&](const std::string& letters) { return source.texts.add(letters); };
  std::vector<uint32_t> layers, storeys;
  for (int i = 0; i < 5; ++i) layers.push_back(text("layer " + std::to_string(i)));
  for (int i = 0; i < 3; ++i) storeys.push_back(text("storey " + std::to_string(i)));
  for (SourceObjectId id = 0; id < count; ++id) {
    source.objects.push_back({.name = text("object " + std::to_string(id)),
                              .layer = layers[id % layers.size()],
                              .storey = storeys[id / 4 % storeys.size()],
                              .parent = id % 7 == 6 ? id - 1 : no_id});
  }
  model.source_objects = std::move(source);
  return model;
}

/// One, a few, every second, most or all of so many objects; or none.
inline ObjectSet random_set(scenes::Random& random, size_t count) {
  ObjectSet set;
  const uint32_t kind = random.index(6);
  const uint32_t one = random.index(count);
  for (SourceObjectId id = 0; id < count; ++id) {
    const bool hides = kind == 1   ? id == one
                       : kind == 2 ? random.index(8) == 0
                       : kind == 3 ? id % 2 == one % 2
                       : kind == 4 ? random.index(8) != 0
                                   : kind == 5 && (random.index(2) == 0 || one % 4 == 0);
    if (hides) set.push_back(id);
  }
  return set;
}

}  // namespace triptych::test
