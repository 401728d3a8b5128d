#include "model/flatten.hpp"

#include <glm/mat4x4.hpp>

namespace triptych {

Model flattened(Model model) {
  std::vector<GroupInstance> open(model.group_instances.rbegin(), model.group_instances.rend());
  while (!open.empty()) {
    const GroupInstance placed = open.back();
    open.pop_back();
    const Group& group = model.groups[placed.group];
    for (const Instance& instance : group.instances)
      model.instances.push_back({instance.mesh, placed.transform * glm::dmat4(instance.transform),
                                 object_in(placed.first_object, instance.object)});
    for (size_t i = group.groups.size(); i-- > 0;) {
      const GroupInstance& inner = group.groups[i];
      open.push_back({inner.group, placed.transform * glm::dmat4(inner.transform),
                      object_in(placed.first_object, inner.first_object)});
    }
  }
  model.groups.clear();
  model.group_instances.clear();
  return model;
}

}  // namespace triptych
