// Subtrees of a glTF scene that repeat.
#include "base/bytes.hpp"
#include "model/import/import_gltf_motion.hpp"

#include <string>
#include <unordered_map>

namespace triptych {

namespace {

/// Subtrees that are equal but for the transform of the topmost node.
struct Kind {
  std::vector<uint32_t> children;  ///< kinds, each with a smaller number than this one
  uint64_t placements = 0, triangles = 0;
  size_t node = 0;  ///< the first node of this kind
};

uint64_t elements(const GltfDocument& gltf, int64_t accessor) {
  return accessor >= 0 && static_cast<size_t>(accessor) < gltf.accessors.size()
             ? gltf.accessors[static_cast<size_t>(accessor)].count
             : 0;
}

/// As counted by the file; whether that is right is found when it is read.
uint64_t triangles_of(const GltfDocument& gltf, int64_t mesh) {
  if (mesh < 0 || static_cast<size_t>(mesh) >= gltf.meshes.size()) return 0;
  uint64_t triangles = 0;
  for (const GltfPrimitive& primitive : gltf.meshes[static_cast<size_t>(mesh)].primitives) {
    const auto positions = primitive.attributes.find("POSITION");
    if (positions == primitive.attributes.end()) continue;
    triangles += elements(gltf, primitive.indices >= 0 ? primitive.indices : positions->second) / 3;
  }
  return triangles;
}

/// Writes the accessors of EXT_mesh_gpu_instancing; returns how many placements they are; 1 without any.
uint64_t write_instancing(const GltfDocument& gltf, const GltfNode& node, ByteWriter& key) {
  key.write(static_cast<uint8_t>(node.instancing.has_value()));
  if (!node.instancing) return 1;
  uint64_t count = 1;
  for (const auto& [name, accessor] : *node.instancing) {
    key.write_text(name);
    key.write(accessor);
    count = std::max(count, elements(gltf, accessor));
  }
  return count;
}

void write_transform(const GltfNode& node, ByteWriter& key) {
  for (const auto* values : {&node.matrix, &node.translation, &node.rotation, &node.scale}) {
    key.write(static_cast<uint32_t>(values->size()));
    key.write_all(std::span<const double>(*values));
  }
}

class Kinds {
 public:
  Kinds(const GltfDocument& gltf, const GltfMotion& motion)
      : of_node(gltf.nodes.size(), GltfGroups::none), gltf_(gltf), motion_(motion) {}

  /// Finds the kind of every node below.
  void add_tree(size_t root) {
    std::vector<std::pair<size_t, bool>> open = {{root, false}};  // whether its children are known
    while (!open.empty()) {
      const auto [node, known] = open.back();
      open.pop_back();
      if (known) {
        add_node(node);
        continue;
      }
      open.emplace_back(node, true);
      for (const int64_t child : gltf_.nodes[node].children)
        open.emplace_back(static_cast<size_t>(child), false);
    }
  }

  std::vector<uint32_t> of_node;
  std::vector<Kind> kinds;

 private:
  void add_node(size_t index) {
    const GltfNode& node = gltf_.nodes[index];
    Kind kind;
    kind.node = index;
    ByteWriter key;
    key.write(node.mesh);
    key.write(static_cast<uint8_t>(node.visible));
    // What a skin moves stands where its joints are, and what moves by itself is where it is at each time: no
    // two such nodes are equal.
    key.write(node.skin >= 0 || motion_.moves(index) ? static_cast<int64_t>(index) : int64_t{-1});
    const uint64_t placements = write_instancing(gltf_, node, key);
    if (node.mesh >= 0 && node.visible) {
      kind.placements = placements;
      kind.triangles = placements * triangles_of(gltf_, node.mesh);
    }
    for (const int64_t child : node.children) {
      const uint32_t of_child = of_node[static_cast<size_t>(child)];
      write_transform(gltf_.nodes[static_cast<size_t>(child)], key);
      key.write(of_child);
      // Each placement of a group has objects of its own, but as many.
      key.write(static_cast<uint8_t>(gltf_node_is_named(gltf_.nodes[static_cast<size_t>(child)])));
      kind.children.push_back(of_child);
      kind.placements += kinds[of_child].placements;
      kind.triangles += kinds[of_child].triangles;
    }
    const auto& bytes = key.bytes();
    const auto [found, inserted] =
        known_.try_emplace(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
                           static_cast<uint32_t>(kinds.size()));
    if (inserted) kinds.push_back(std::move(kind));
    of_node[index] = found->second;
  }

  const GltfDocument& gltf_;
  const GltfMotion& motion_;
  std::unordered_map<std::string, uint32_t> known_;
};

}  // namespace

GltfGroups find_gltf_groups(const GltfDocument& gltf, const std::vector<size_t>& roots,
                            const GltfMotion& motion, const ImportOptions& options) {
  GltfGroups groups;
  groups.of_node.assign(gltf.nodes.size(), GltfGroups::none);
  if (!options.find_groups) return groups;
  Kinds found(gltf, motion);
  for (const size_t root : roots) found.add_tree(root);
  const std::vector<Kind>& kinds = found.kinds;
  // How often each kind occurs where everything that repeats is stored once, and how often in the whole
  // scene. From the topmost down: a kind's number is larger than those of its children.
  std::vector<uint64_t> said(kinds.size(), 0), uses(kinds.size(), 0);
  for (const size_t root : roots) {
    ++said[found.of_node[root]];
    ++uses[found.of_node[root]];
  }
  std::vector<uint8_t> is_group(kinds.size(), 0);
  for (size_t i = kinds.size(); i-- > 0;) {
    const Kind& kind = kinds[i];
    is_group[i] = said[i] >= 2 && kind.placements >= options.group_placements &&
                  kind.triangles >= options.group_triangles;
    for (const uint32_t child : kind.children) {
      said[child] += is_group[i] ? 1 : said[i];
      uses[child] += uses[i];
    }
  }
  std::vector<uint32_t> numbers(kinds.size(), GltfGroups::none);
  for (size_t i = 0; i < kinds.size(); ++i) {
    if (!is_group[i]) continue;
    numbers[i] = static_cast<uint32_t>(groups.nodes.size());
    groups.nodes.push_back(static_cast<uint32_t>(kinds[i].node));
    groups.uses.push_back(uses[i]);
    groups.placements.push_back(kinds[i].placements);
  }
  for (size_t i = 0; i < found.of_node.size(); ++i) {
    if (found.of_node[i] != GltfGroups::none) groups.of_node[i] = numbers[found.of_node[i]];
  }
  return groups;
}

}  // namespace triptych
