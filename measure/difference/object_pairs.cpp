#include "measure/difference/object_pairs.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>

namespace triptych {

namespace {

/// Objects of one name, in both revisions.
struct Namesakes {
  std::vector<SourceObjectId> before, after;
};

/// What an object without a GUID of its own is called, with what it is in.
std::string path_key(const SourceObjects& source, SourceObjectId id) {
  const SourceObject& object = source.objects[id];
  const uint32_t own = object.name != 0 ? object.name : object.type != 0 ? object.type : object.number;
  return "path " + source.path_of(id) + " / " + std::string(source.texts[own]);
}

/// How often each GUID is used.
std::unordered_map<std::string_view, size_t> uses_of_guids(const SourceObjects& source) {
  std::unordered_map<std::string_view, size_t> uses;
  for (const SourceObject& object : source.objects) {
    if (object.guid != 0) ++uses[source.texts[object.guid]];
  }
  return uses;
}

/// A GUID says which object it is; but not one that is doubled in either revision, and none where only one of
/// them has GUIDs.
std::vector<std::string> keys_of(const SourceObjects& source, const SourceObjects& other) {
  const auto uses = uses_of_guids(source), there = uses_of_guids(other);
  const auto is_doubled = [](const auto& counts, std::string_view guid) {
    const auto found = counts.find(guid);
    return found != counts.end() && found->second > 1;
  };
  std::vector<std::string> keys;
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    const uint32_t guid = source.objects[id].guid;
    const bool own = guid != 0 && !there.empty() && !is_doubled(uses, source.texts[guid]) &&
                     !is_doubled(there, source.texts[guid]);
    keys.push_back(own ? "guid " + std::string(source.texts[guid]) : path_key(source, id));
  }
  return keys;
}

class Pairing {
 public:
  Pairing(const ObjectShapes& before, const ObjectShapes& after) : before_(before), after_(after) {}

  void pair(Namesakes names, std::vector<ObjectPair>& pairs) {
    if (names.before.size() > 1 || names.after.size() > 1) {
      pair_by(names, pairs, [](const ObjectShapes& shapes, SourceObjectId id) {
        return std::vector<double>{static_cast<double>(shapes.signature_of(id))};
      });
      pair_by(names, pairs, [&](const ObjectShapes& shapes, SourceObjectId id) { return place(shapes, id); });
    }
    const size_t both = std::min(names.before.size(), names.after.size());
    for (size_t i = 0; i < both; ++i) pairs.push_back({names.before[i], names.after[i]});
    for (size_t i = both; i < names.after.size(); ++i) pairs.push_back({no_id, names.after[i]});
    for (size_t i = both; i < names.before.size(); ++i) pairs.push_back({names.before[i], no_id});
  }

 private:
  /// Where its box is, in steps that are coarse against what lattices round by.
  std::vector<double> place(const ObjectShapes& shapes, SourceObjectId id) const {
    const double step =
        64 * std::max(before_.pack().skeleton().lattice().step, after_.pack().skeleton().lattice().step);
    const Box box = shapes.box_of(id);
    if (box.empty()) return {};
    const glm::dvec3 low = glm::round(box.lo / step), high = glm::round(box.hi / step);
    return {low.x, low.y, low.z, high.x, high.y, high.z};
  }

  /// Pairs those that have the same key, and takes them out.
  template <typename Key>
  void pair_by(Namesakes& names, std::vector<ObjectPair>& pairs, const Key& key_of) {
    std::map<std::vector<double>, std::vector<SourceObjectId>> waiting;  // the last one is taken first
    for (size_t i = names.before.size(); i-- > 0;)
      waiting[key_of(before_, names.before[i])].push_back(names.before[i]);
    std::vector<SourceObjectId> left;
    for (const SourceObjectId id : names.after) {
      auto found = waiting.find(key_of(after_, id));
      if (found == waiting.end() || found->second.empty()) {
        left.push_back(id);
        continue;
      }
      pairs.push_back({found->second.back(), id});
      found->second.pop_back();
    }
    names.after = std::move(left);
    names.before.clear();
    for (const auto& [key, ids] : waiting) names.before.insert(names.before.end(), ids.begin(), ids.end());
    std::sort(names.before.begin(), names.before.end());
  }

  const ObjectShapes& before_;
  const ObjectShapes& after_;
};

}  // namespace

std::vector<ObjectPair> pair_objects(const SourceObjects& before, const ObjectShapes& before_shapes,
                                     const SourceObjects& after, const ObjectShapes& after_shapes) {
  std::unordered_map<std::string, Namesakes> all;
  const std::vector<std::string> before_keys = keys_of(before, after), after_keys = keys_of(after, before);
  for (SourceObjectId id = 0; id < before_keys.size(); ++id) all[before_keys[id]].before.push_back(id);
  for (SourceObjectId id = 0; id < after_keys.size(); ++id) all[after_keys[id]].after.push_back(id);
  std::vector<ObjectPair> pairs;
  Pairing pairing(before_shapes, after_shapes);
  for (auto& [key, names] : all) pairing.pair(std::move(names), pairs);
  std::sort(pairs.begin(), pairs.end(), [](const ObjectPair& a, const ObjectPair& b) {
    return std::pair(a.after, a.before) < std::pair(b.after, b.before);
  });
  return pairs;
}

}  // namespace triptych
