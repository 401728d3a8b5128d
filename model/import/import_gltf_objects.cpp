// Which nodes of a glTF scene are objects.
#include "model/import/import_gltf.hpp"

#include <algorithm>

namespace triptych {

namespace {

const std::string& mesh_name(const GltfDocument& gltf, const GltfNode& node) {
  static const std::string none;
  const bool known = node.mesh >= 0 && static_cast<size_t>(node.mesh) < gltf.meshes.size();
  return known ? gltf.meshes[static_cast<size_t>(node.mesh)].name : none;
}

/// Calls take(node, parent) for every node that is shown, parents first; the subtree of a node is contiguous.
template <typename Take>
void each_node(const GltfDocument& gltf, const std::vector<size_t>& roots, const Take& take) {
  constexpr size_t none = static_cast<size_t>(-1);
  std::vector<std::pair<size_t, size_t>> open;
  for (size_t i = roots.size(); i-- > 0;) open.emplace_back(roots[i], none);
  while (!open.empty()) {
    const auto [index, parent] = open.back();
    open.pop_back();
    const GltfNode& node = gltf.nodes[index];
    if (!node.visible) continue;
    take(index, parent == none ? std::nullopt : std::optional(parent));
    for (size_t i = node.children.size(); i-- > 0;)
      open.emplace_back(static_cast<size_t>(node.children[i]), index);
  }
}

}  // namespace

bool gltf_node_is_named(const GltfNode& node) { return !node.name.empty() || !node.extras.empty(); }

std::vector<SourceObjectId> add_gltf_objects(const GltfDocument& gltf, const std::vector<size_t>& roots,
                                             const GltfGroups& groups, FileImport& target) {
  std::vector<SourceObjectId> objects(gltf.nodes.size(), no_id);
  bool any = false;
  each_node(gltf, roots, [&](size_t index, std::optional<size_t>) {
    const GltfNode& node = gltf.nodes[index];
    any = any || gltf_node_is_named(node) || !mesh_name(gltf, node).empty();
  });
  if (!any) return objects;
  each_node(gltf, roots, [&](size_t index, std::optional<size_t> parent) {
    const GltfNode& node = gltf.nodes[index];
    const SourceObjectId within = parent ? objects[*parent] : no_id;
    const std::string& of_mesh = mesh_name(gltf, node);
    if (!gltf_node_is_named(node) && groups.of_node[index] == GltfGroups::none &&
        (within != no_id || of_mesh.empty())) {
      objects[index] = within;
      return;
    }
    std::vector<uint32_t> sets;
    if (!node.extras.empty()) sets.push_back(target.objects().add_set("extras", node.extras));
    objects[index] = target.objects().add({.name = node.name.empty() ? of_mesh : node.name,
                                           .type = node.name.empty() || of_mesh == node.name ? "" : of_mesh},
                                          within, sets);
  });
  return objects;
}

}  // namespace triptych
