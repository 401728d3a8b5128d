// What is placed in each hierarchy of a pack: groups that become sub-hierarchies, and all else one by one.
#pragma once

#include "model/model.hpp"
#include "preprocess/build.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace triptych {

/// Of one hierarchy, in its own space.
struct HierarchyPlacements {
  std::span<const Instance> instances;  ///< as the model has them
  std::vector<Instance> inlined;        ///< of groups that are no sub-hierarchies here
  std::vector<GroupInstance> groups;    ///< GroupInstance::group: index of a hierarchy before this one
  uint64_t uses = 1;                    ///< how often it stands in the model
  double stretch = 1;                   ///< of its placements in the model the largest

  template <typename Take>
  void each_instance(const Take& take) const {
    for (const Instance& instance : instances) take(instance);
    for (const Instance& instance : inlined) take(instance);
  }
};

/// Sub-hierarchies before those that they are in, and last the model's own. The model must outlive them.
///
/// A group's placement is an instance of a sub-hierarchy if all that is in it can be placed exactly enough
/// (BuildRules::max_condition), and is placed in at least two places as one. Otherwise what is in it is
/// placed one by one.
std::vector<HierarchyPlacements> place_groups(const Model& model, const BuildOptions& options);

}  // namespace triptych
