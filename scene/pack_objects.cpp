#include "scene/pack_objects.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <optional>

namespace triptych {

PackObjects::PackObjects(StoredObjects stored, const Skeleton& skeleton, const std::string& place)
    : skeleton_(skeleton), source_(std::move(stored.objects)), hierarchies_(std::move(stored.hierarchies)) {
  if (!hierarchies_.empty()) find_places(place);
  check_places(place);
  index_nodes();
}

/// Instances come in the order of a queue (scene/expand.hpp): those of the surrounding hierarchy, then those
/// in the first one's sub-hierarchy, and so on.
void PackObjects::find_places(const std::string& place) {
  const auto& instances = skeleton_.instances;
  if (hierarchies_.size() != size_t{1} + skeleton_.sub_hierarchies)
    fail(place, "is of {} hierarchies, the skeleton has {}", hierarchies_.size(),
         skeleton_.sub_hierarchies + 1);
  std::vector<SourceObjectId> firsts = hierarchies_[0].instances;
  for (size_t i = 0; i < std::min(firsts.size(), instances.size()); ++i) {
    const auto& inner = hierarchies_[instances[i].sub_hierarchy + 1].instances;
    if (firsts.size() + inner.size() > instances.size()) break;
    for (const SourceObjectId local : inner) firsts.push_back(object_in(firsts[i], local));
  }
  if (firsts.size() != instances.size())
    fail(place, "is of {} instances, the skeleton has {}", firsts.size(), instances.size());
  const auto surrounding = static_cast<SceneNodeId>(instances.empty() ? skeleton_.scene_nodes.size()
                                                                      : instances.front().first_scene_node);
  const auto drawables = static_cast<DrawableId>(instances.empty() ? skeleton_.drawables.size()
                                                                   : instances.front().first_drawable);
  places_.push_back({0, surrounding, 0, drawables, 0, 0});
  for (size_t i = 0; i < instances.size(); ++i) {
    places_.push_back({instances[i].first_scene_node,
                       instances[i].first_scene_node + instances[i].scene_node_count,
                       instances[i].first_drawable, instances[i].first_drawable + instances[i].drawable_count,
                       instances[i].sub_hierarchy + 1, firsts[i]});
  }
}

/// What a hierarchy says fits the scene nodes and drawables in one of its places; the others are alike.
/// Returns how many objects its largest local id asks for.
uint64_t PackObjects::check_hierarchy(const Place& place, const std::string& name) const {
  const HierarchyObjects& hierarchy = hierarchies_[place.hierarchy];
  uint64_t wanted = 0;
  const auto want = [&](SourceObjectId object) {
    if (object != no_id) wanted = std::max(wanted, uint64_t{object} + 1);
  };
  for (size_t i = 0; i < hierarchy.leaves.size(); ++i) {
    const SceneNodeId count = place.end_scene_node - place.first_scene_node;
    if (hierarchy.leaves[i] >= count) fail(name, "names scene node {} of {}", hierarchy.leaves[i], count);
    const SceneNode& node = skeleton_.scene_nodes[place.first_scene_node + hierarchy.leaves[i]];
    uint64_t placements = 0;
    for (const ObjectRun& run : hierarchy.runs_of(i)) {
      placements += run.placements;
      want(run.object);
    }
    for (uint32_t k = 0; k < node.drawable_count; ++k) {
      const Drawable& drawable = skeleton_.drawables[node.first_drawable + k];
      if (drawable.placement_count != placements)
        fail(name, "says of {} placements what they are, a drawable has {}", placements,
             drawable.placement_count);
    }
  }
  for (size_t i = 0; i < hierarchy.drawables.size(); ++i) {
    const DrawableId count = place.end_drawable - place.first_drawable;
    if (hierarchy.drawables[i] >= count) fail(name, "names drawable {} of {}", hierarchy.drawables[i], count);
    const Drawable& drawable = skeleton_.drawables[place.first_drawable + hierarchy.drawables[i]];
    uint64_t triangles = 0;
    each_run(hierarchy.triangles_of(i), name, [&](uint64_t run, SourceObjectId object) {
      if (run > drawable.triangles - std::min<uint64_t>(triangles, drawable.triangles))
        fail(name, "says of more triangles what they are than the {} of a drawable", drawable.triangles);
      triangles += run;
      want(object);
    });
    if (triangles != drawable.triangles)
      fail(name, "says of {} triangles what they are, a drawable has {}", triangles, drawable.triangles);
  }
  return wanted;
}

void PackObjects::check_places(const std::string& name) const {
  std::vector<std::optional<uint64_t>> wanted(hierarchies_.size());
  for (const Place& place : places_) {
    if (!wanted[place.hierarchy]) wanted[place.hierarchy] = check_hierarchy(place, name);
    if (place.first_object == no_id) continue;
    if (place.first_object + *wanted[place.hierarchy] > source_.objects.size())
      fail(name, "names object {} of {}", place.first_object + *wanted[place.hierarchy] - 1,
           source_.objects.size());
  }
}

/// Calls take(scene node, object) for every object of every leaf; the same one can come again.
template <typename Take>
void PackObjects::each_leaf(const Take& take) const {
  for (const Place& place : places_) {
    if (place.first_object == no_id) continue;
    const HierarchyObjects& hierarchy = hierarchies_[place.hierarchy];
    for (size_t i = 0; i < hierarchy.leaves.size(); ++i) {
      for (const ObjectRun& run : hierarchy.runs_of(i)) {
        if (run.object != no_id)
          take(place.first_scene_node + hierarchy.leaves[i], place.first_object + run.object);
      }
    }
  }
}

void PackObjects::index_nodes() {
  std::vector<std::pair<SourceObjectId, SceneNodeId>> pairs;
  each_leaf([&](SceneNodeId node, SourceObjectId object) { pairs.emplace_back(object, node); });
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_nodes_.assign(source_.objects.size() + 1, 0);
  for (const auto& [object, node] : pairs) {
    ++first_nodes_[object + 1];
    nodes_.push_back(node);
  }
  for (size_t i = 1; i < first_nodes_.size(); ++i) first_nodes_[i] += first_nodes_[i - 1];
}

std::span<const SceneNodeId> PackObjects::nodes_of(SourceObjectId object) const {
  return std::span(nodes_).subspan(first_nodes_[object], first_nodes_[object + 1] - first_nodes_[object]);
}

const PackObjects::Place* PackObjects::place_of(SceneNodeId node) const {
  const auto behind =
      std::upper_bound(places_.begin(), places_.end(), node,
                       [](SceneNodeId id, const Place& place) { return id < place.first_scene_node; });
  return behind == places_.begin() ? nullptr : &behind[-1];
}

LeafRuns PackObjects::stored_runs_of(SceneNodeId leaf) const {
  const Place* const place = place_of(leaf);
  if (!place) return {};
  const HierarchyObjects& hierarchy = hierarchies_[place->hierarchy];
  const SceneNodeId local = leaf - place->first_scene_node;
  const auto found = std::lower_bound(hierarchy.leaves.begin(), hierarchy.leaves.end(), local);
  if (found == hierarchy.leaves.end() || *found != local) return {};
  return {hierarchy.runs_of(static_cast<size_t>(found - hierarchy.leaves.begin())), place->first_object};
}

std::vector<ObjectRun> PackObjects::runs_of(SceneNodeId leaf) const {
  const LeafRuns stored = stored_runs_of(leaf);
  std::vector<ObjectRun> runs(stored.runs.begin(), stored.runs.end());
  for (ObjectRun& run : runs) run.object = object_in(stored.first_object, run.object);
  return runs;
}

std::vector<SourceObjectId> PackObjects::objects_below(SceneNodeId node) const {
  std::vector<SourceObjectId> objects;
  std::vector<SceneNodeId> open = {node};
  while (!open.empty()) {
    const SceneNode& at = skeleton_.scene_nodes[open.back()];
    for (const ObjectRun& run : runs_of(open.back())) {
      if (run.object != no_id) objects.push_back(run.object);
    }
    open.pop_back();
    for (uint32_t i = 0; i < at.child_count; ++i) open.push_back(at.first_child + i);
  }
  std::sort(objects.begin(), objects.end());
  objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
  return objects;
}

SourceObjectId PackObjects::object_at(DrawableId drawable, uint32_t placement, uint32_t triangle) const {
  const SceneNodeId node = skeleton_.drawables[drawable].scene_node;
  uint64_t end = 0;
  for (const ObjectRun& run : runs_of(node)) {
    end += run.placements;
    if (placement < end) return run.object;
  }
  const Place* const place = place_of(node);
  if (!place) return no_id;
  const HierarchyObjects& hierarchy = hierarchies_[place->hierarchy];
  const DrawableId local = drawable - place->first_drawable;
  const auto found = std::lower_bound(hierarchy.drawables.begin(), hierarchy.drawables.end(), local);
  if (found == hierarchy.drawables.end() || *found != local) return no_id;
  SourceObjectId object = no_id;
  end = 0;
  each_run(hierarchy.triangles_of(static_cast<size_t>(found - hierarchy.drawables.begin())), "section OBJS",
           [&](uint64_t run, SourceObjectId of_run) {
             if (triangle >= end && triangle < end + run) object = object_in(place->first_object, of_run);
             end += run;
           });
  return object;
}

}  // namespace triptych
