#include "light/moving_things.hpp"

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

MovingThings take_moving_things(Model& model) {
  MovingThings things;
  const auto rests = [](const GroupInstance& instance) { return instance.joint == no_id; };
  const auto moving =
      std::stable_partition(model.group_instances.begin(), model.group_instances.end(), rests);
  things.instances.assign(moving, model.group_instances.end());
  model.group_instances.erase(moving, model.group_instances.end());
  if (things.empty()) return things;
  things.motion = std::exchange(model.motion, {});
  things.groups = model.groups;
  const std::vector<uint8_t> placed = placed_groups(things.instances, things.groups);
  tsl::robin_map<uint32_t, uint32_t> numbers;
  for (size_t i = 0; i < things.groups.size(); ++i) {
    if (!placed[i]) things.groups[i] = {};
    for (Instance& instance : things.groups[i].instances) {
      const auto [found, inserted] =
          numbers.try_emplace(instance.mesh, static_cast<uint32_t>(things.meshes.size()));
      if (inserted) things.meshes.push_back(model.meshes[instance.mesh]);
      instance.mesh = found->second;
    }
  }
  return things;
}

void put_back(MovingThings things, Model& model) {
  if (things.empty()) return;
  const auto first = static_cast<uint32_t>(model.meshes.size());
  for (Mesh& mesh : things.meshes) model.meshes.push_back(std::move(mesh));
  for (Group& group : things.groups) {
    for (Instance& instance : group.instances) instance.mesh += first;
  }
  model.groups = std::move(things.groups);
  model.group_instances = std::move(things.instances);
  model.motion = std::move(things.motion);
}

}  // namespace triptych
