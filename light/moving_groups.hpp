// What moves has no light baked into it: it would be wrong as soon as it moves.
#pragma once

#include "model/model.hpp"

#include <vector>

namespace triptych {

/// The moving parts of a model: groups that follow joints, with meshes of their own.
struct MovingGroups {
  std::vector<Mesh> meshes;
  std::vector<Group> groups;
  std::vector<GroupInstance> instances;
  Motion motion;

  bool empty() const { return instances.empty(); }
};

/// Takes what moves out of the model, which then rests as a whole: it neither gives light nor throws shadows.
MovingGroups take_moving_groups(Model& model);

/// Puts them into a model without groups.
void put_back(MovingGroups taken, Model& model);

}  // namespace triptych
