#include "preprocess/placements.hpp"

#include "scene/transforms.hpp"

#include <algorithm>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

Affine compose(const Affine& outer, const Affine& inner) { return outer * glm::dmat4(inner); }

class GroupPlacer {
 public:
  GroupPlacer(const Model& model, const BuildOptions& options) : model_(model), options_(options) {
    moves_.resize(model.groups.size() + 1, false);
    for (const GroupInstance& placed : model.group_instances)
      if (placed.joint != no_id) moves_[placed.group] = true;
    for (const Group& group : model.groups) {
      hierarchies_.push_back({group.instances, {}, {}});
      if (!shares() && !moves_[hierarchies_.size() - 1]) continue;  // not needed
      for (const GroupInstance& placed : group.groups) place(placed, hierarchies_.back());
    }
    hierarchies_.push_back({model.instances, {}, {}});
    for (const GroupInstance& placed : model.group_instances) place(placed, hierarchies_.back());
  }

  std::vector<HierarchyPlacements> run() {
    inline_single_ones();
    drop_unused_ones();
    count_uses();
    return std::move(hierarchies_);
  }

 private:
  /// The groups within the placed one have been handled before.
  void place(const GroupInstance& placed, HierarchyPlacements& hierarchy) const {
    if (placed.joint != no_id || (shares() && fits(hierarchies_[placed.group], placed.transform))) {
      hierarchy.groups.push_back(placed);
    } else {
      inline_group(placed, hierarchy);
    }
  }

  /// Groups are shared only where meshes are, and not with the plain median split.
  bool shares() const {
    return options_.share_instances && options_.hierarchy == HierarchyKind::partition_cluster_partition;
  }

  bool usable(const Affine& transform) const {
    return is_finite(transform) && well_conditioned(transform, options_.rules.max_condition);
  }

  /// Whether all that is in it can be placed under the transform.
  bool fits(const HierarchyPlacements& hierarchy, const Affine& transform) const {
    if (!usable(transform)) return false;
    bool all = true;
    hierarchy.each_instance([&](const Instance& instance) {
      // Geometry that is baked into the group's space is placed by the group's transform only.
      all = all && (!usable(instance.transform) || usable(compose(transform, instance.transform)));
    });
    return all &&
           std::all_of(hierarchy.groups.begin(), hierarchy.groups.end(), [&](const GroupInstance& inner) {
             return fits(hierarchies_[inner.group], compose(transform, inner.transform));
           });
  }

  /// Places the group's content one by one; parts of it may still become instances.
  void inline_group(const GroupInstance& placed, HierarchyPlacements& into) const {
    const Group& group = model_.groups[placed.group];
    for (const Instance& instance : group.instances)
      into.inlined.push_back({instance.mesh, compose(placed.transform, instance.transform),
                              object_in(placed.first_object, instance.object)});
    for (const GroupInstance& inner : group.groups)
      place({inner.group, compose(placed.transform, inner.transform),
             object_in(placed.first_object, inner.first_object)},
            into);
  }

  /// From the outermost down: a group with a single place becomes part of what it is in.
  void inline_single_ones() {
    std::vector<uint64_t> places(hierarchies_.size(), 0);
    std::vector<size_t> users(hierarchies_.size(), 0);
    places.back() = 1;
    for (size_t i = hierarchies_.size(); i-- > 0;) {
      if (places[i] == 0) continue;  // it is not placed
      if (places[i] == 1 && i + 1 < hierarchies_.size() && !moves_[i]) {
        inline_in(static_cast<uint32_t>(i), hierarchies_[users[i]]);
        for (const GroupInstance& inner : hierarchies_[i].groups) {
          ++places[inner.group];
          users[inner.group] = users[i];
        }
        continue;
      }
      for (const GroupInstance& inner : hierarchies_[i].groups) {
        ++places[inner.group];
        users[inner.group] = i;
      }
    }
    used_ = std::move(places);
    for (size_t i = 0; i + 1 < used_.size(); ++i) used_[i] = used_[i] >= 2 || (moves_[i] && used_[i] > 0);
  }

  void inline_in(uint32_t group, HierarchyPlacements& user) const {
    const auto found = std::find_if(user.groups.begin(), user.groups.end(),
                                    [&](const GroupInstance& instance) { return instance.group == group; });
    const GroupInstance placed = *found;
    user.groups.erase(found);
    const HierarchyPlacements& hierarchy = hierarchies_[group];
    hierarchy.each_instance([&](const Instance& instance) {
      user.inlined.push_back({instance.mesh, compose(placed.transform, instance.transform),
                              object_in(placed.first_object, instance.object)});
    });
    for (const GroupInstance& inner : hierarchy.groups)
      user.groups.push_back({inner.group, compose(placed.transform, inner.transform),
                             object_in(placed.first_object, inner.first_object)});
  }

  void drop_unused_ones() {
    std::vector<uint32_t> numbers;
    std::vector<HierarchyPlacements> kept;
    for (size_t i = 0; i < hierarchies_.size(); ++i) {
      numbers.push_back(static_cast<uint32_t>(kept.size()));
      if (used_[i] == 0) continue;
      for (GroupInstance& inner : hierarchies_[i].groups) inner.group = numbers[inner.group];
      kept.push_back(std::move(hierarchies_[i]));
    }
    hierarchies_ = std::move(kept);
  }

  void count_uses() {
    for (size_t i = 0; i + 1 < hierarchies_.size(); ++i) hierarchies_[i].uses = 0;
    for (size_t i = hierarchies_.size(); i-- > 0;) {
      const HierarchyPlacements& outer = hierarchies_[i];
      for (const GroupInstance& instance : outer.groups) {
        HierarchyPlacements& inner = hierarchies_[instance.group];
        const double stretch =
            outer.stretch * (instance.joint == no_id ? largest_stretch(instance.transform)
                                                     : largest_stretch(model_.motion, instance.joint));
        inner.stretch = inner.uses == 0 ? stretch : std::max(inner.stretch, stretch);
        inner.uses += outer.uses;
      }
    }
  }

  const Model& model_;
  const BuildOptions& options_;
  std::vector<HierarchyPlacements> hierarchies_;
  std::vector<bool> moves_;     ///< groups that are placed by joints
  std::vector<uint64_t> used_;  ///< whether the hierarchy is placed; the model's own is
};

}  // namespace

std::vector<HierarchyPlacements> place_groups(const Model& model, const BuildOptions& options) {
  return GroupPlacer(model, options).run();
}

}  // namespace triptych
