// What is placed in each hierarchy of a pack: groups that become sub-hierarchies, and everything else one by
// one.
#pragma once

#include "model/model.hpp"
#include "preprocess/build.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// The placements in one hierarchy, in its own space.
struct HierarchyPlacements {
  std::span<const Instance> instances;  ///< as the model has them
  std::vector<Instance> inlined;        ///< of groups that do not become sub-hierarchies
  std::vector<GroupInstance> groups;    ///< GroupInstance::group: index of a hierarchy before this one
  uint64_t uses = 1;                    ///< how many places it has in the model
  double stretch = 1;                   ///< the largest of its placements in the model

  template <typename Take>
  void each_instance(const Take& take) const {
    for (const Instance& instance : instances) take(instance);
    for (const Instance& instance : inlined) take(instance);
  }
};

/// Sub-hierarchies before those that they are in, and last the model's own. The model must outlive them.
///
/// A group's placement becomes an instance of a sub-hierarchy if all of its content can be placed precisely
/// enough (BuildRules::max_condition), and if the group has at least two such placements. Otherwise its
/// content is placed one by one. What moves is always an instance.
std::vector<HierarchyPlacements> place_groups(const Model& model, const BuildOptions& options);

}  // namespace triptych
