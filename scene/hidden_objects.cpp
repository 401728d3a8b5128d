#include "scene/hidden_objects.hpp"

#include "base/error.hpp"
#include "base/hashing.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace triptych {

HiddenName hidden_name(std::span<const uint32_t> objects) {
  if (objects.empty()) return {};
  return {static_cast<uint32_t>(objects.size()), hash_values(objects)};
}

ObjectSet with_contents(const SourceObjects& source, std::span<const SourceObjectId> objects) {
  std::vector<bool> within(source.objects.size());
  for (const SourceObjectId id : objects) within[id] = true;
  ObjectSet found;
  for (SourceObjectId id = 0; id < within.size(); ++id) {  // what an object is in comes before it
    const SourceObjectId parent = source.objects[id].parent;
    if (parent != no_id && within[parent]) within[id] = true;
    if (within[id]) found.push_back(id);
  }
  return found;
}

ObjectSet all_but(const SourceObjects& source, const ObjectSet& objects) {
  ObjectSet others;
  auto next = objects.begin();
  for (SourceObjectId id = 0; id < source.objects.size(); ++id) {
    if (next != objects.end() && *next == id) {
      ++next;
    } else {
      others.push_back(id);
    }
  }
  return others;
}

ObjectSet united(const ObjectSet& one, const ObjectSet& other) {
  ObjectSet both;
  std::set_union(one.begin(), one.end(), other.begin(), other.end(), std::back_inserter(both));
  return both;
}

HiddenObjects::HiddenObjects(const Skeleton& skeleton, const PackObjects& of_pack, ObjectSet objects,
                             const std::string& place)
    : skeleton_(skeleton), objects_(std::move(objects)), marks_(skeleton.scene_nodes.size(), shown) {
  if (std::adjacent_find(objects_.begin(), objects_.end(), std::greater_equal<>()) != objects_.end())
    fail(place, "the ids of hidden objects are not ascending");
  const size_t count = of_pack.source().objects.size();
  if (!objects_.empty() && objects_.back() >= count)
    fail(place, "object {} of {} is hidden", objects_.back(), count);
  mark_leaves(of_pack);
}

void HiddenObjects::mark_leaves(const PackObjects& of_pack) {
  std::vector<bool> is_hidden(of_pack.source().objects.size());
  std::vector<SceneNodeId> leaves;
  for (const SourceObjectId id : objects_) {
    is_hidden[id] = true;
    for (const SceneNodeId leaf : of_pack.nodes_of(id)) {
      if (marks_[leaf] == shown) leaves.push_back(leaf);
      marks_[leaf] = mixed;
    }
  }
  for (const SceneNodeId leaf : leaves) mark_leaf(of_pack, leaf, is_hidden);
  mark_parents(leaves);
}

void HiddenObjects::mark_leaf(const PackObjects& of_pack, SceneNodeId leaf,
                              const std::vector<bool>& is_hidden) {
  const LeafRuns of_leaf = of_pack.stored_runs_of(leaf);
  const size_t begin = runs_.size();
  uint32_t end = 0;
  bool whole = true;
  for (const ObjectRun& run : of_leaf.runs) {
    const uint32_t first = std::exchange(end, end + run.placements);
    const SourceObjectId object = object_in(of_leaf.first_object, run.object);
    if (object == no_id || !is_hidden[object]) {
      whole = whole && run.placements == 0;
    } else if (runs_.size() > begin && runs_.back().end == first) {
      runs_.back().end = end;
    } else if (run.placements > 0) {
      runs_.push_back({first, end});
    }
  }
  if (whole) {
    marks_[leaf] = gone;
    runs_.resize(begin);
  } else {
    marks_[leaf] = first_leaf + static_cast<uint32_t>(ends_.size());
    ends_.push_back(static_cast<uint32_t>(runs_.size()));
  }
}

void HiddenObjects::mark_parents(const std::vector<SceneNodeId>& leaves) {
  std::vector<SceneNodeId> above;
  for (const SceneNodeId leaf : leaves) {
    for (SceneNodeId node = skeleton_.scene_nodes[leaf].parent; node != no_id && marks_[node] == shown;
         node = skeleton_.scene_nodes[node].parent) {
      marks_[node] = mixed;
      above.push_back(node);
    }
  }
  std::sort(above.begin(), above.end(), std::greater<>());  // children come after their parents
  for (const SceneNodeId node : above) {
    const SceneNode& parent = skeleton_.scene_nodes[node];
    const auto children = marks_.begin() + parent.first_child;
    if (std::all_of(children, children + parent.child_count, [](uint32_t mark) { return mark == gone; }))
      marks_[node] = gone;
  }
}

Hiding hide(const Skeleton& skeleton, const PackObjects& of_pack, ObjectSet objects,
            const std::string& place) {
  if (objects.empty()) return {};
  auto applied = std::make_shared<const HiddenObjects>(skeleton, of_pack, std::move(objects), place);
  return {hidden_name(applied->objects()), std::move(applied)};
}

}  // namespace triptych
