#include "light/moving_groups.hpp"

#include <algorithm>
#include <tsl/robin_map.h>

namespace triptych {

namespace {

/// Which groups the instances place, and those within them.
std::vector<uint8_t> placed_groups(const std::vector<GroupInstance>& instances,
                                   const std::vector<Group>& groups) {
  std::vector<uint8_t> placed(groups.size(), 0);
  for (const GroupInstance& instance : instances) placed[instance.group] = 1;
  for (size_t i = groups.size(); i-- > 0;) {  // a group has only groups before it
    for (const GroupInstance& inner : groups[i].groups) placed[inner.group] |= placed[i];
  }
  return placed;
}

}  // namespace

MovingGroups take_moving_groups(Model& model) {
  MovingGroups taken;
  const auto rests = [](const GroupInstance& instance) { return instance.joint == no_id; };
  const auto moving =
      std::stable_partition(model.group_instances.begin(), model.group_instances.end(), rests);
  taken.instances.assign(moving, model.group_instances.end());
  model.group_instances.erase(moving, model.group_instances.end());
  if (taken.empty()) return taken;
  taken.motion = std::exchange(model.motion, {});
  taken.groups = model.groups;
  const std::vector<uint8_t> placed = placed_groups(taken.instances, taken.groups);
  tsl::robin_map<uint32_t, uint32_t> numbers;
  for (size_t i = 0; i < taken.groups.size(); ++i) {
    if (!placed[i]) taken.groups[i] = {};
    for (Instance& instance : taken.groups[i].instances) {
      const auto [found, inserted] =
          numbers.try_emplace(instance.mesh, static_cast<uint32_t>(taken.meshes.size()));
      if (inserted) taken.meshes.push_back(model.meshes[instance.mesh]);
      instance.mesh = found->second;
    }
  }
  return taken;
}

void put_back(MovingGroups taken, Model& model) {
  if (taken.empty()) return;
  const auto first = static_cast<uint32_t>(model.meshes.size());
  for (Mesh& mesh : taken.meshes) model.meshes.push_back(std::move(mesh));
  for (Group& group : taken.groups) {
    for (Instance& instance : group.instances) instance.mesh += first;
  }
  model.groups = std::move(taken.groups);
  model.group_instances = std::move(taken.instances);
  model.motion = std::move(taken.motion);
}

}  // namespace triptych
