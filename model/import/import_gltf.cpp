// glTF 2.0 and its binary form: the node tree, composed in double.
#include "model/import/import_gltf.hpp"

#include "base/error.hpp"
#include "model/import/import_gltf_motion.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace triptych {

namespace {

/// First `inner`, then `outer`.
Affine compose(const Affine& outer, const Affine& inner) { return outer * glm::dmat4(inner); }

/// A rotation without a length turns nothing.
Affine from_parts(const glm::dvec3& translation, const glm::dquat& rotation, const glm::dvec3& scale) {
  const double length = glm::length(rotation);
  const bool turns = length > 0 && std::isfinite(length);
  const glm::dmat3 turn = turns ? glm::mat3_cast(rotation / length) : glm::dmat3(1);
  return Affine(turn[0] * scale.x, turn[1] * scale.y, turn[2] * scale.z, translation);
}

}  // namespace

Affine gltf_local_transform(const GltfNode& node, const std::string& place) {
  const auto expect = [&](const std::vector<double>& values, size_t count, const char* what) {
    if (!values.empty() && values.size() != count) fail(place, "a {} of {} numbers", what, values.size());
    return !values.empty();
  };
  if (expect(node.matrix, 16, "matrix")) {  // its last row was rounded, or is of no use
    const auto& m = node.matrix;
    return Affine(m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]);
  }
  glm::dvec3 translation{0}, scale{1};
  glm::dquat rotation(1, 0, 0, 0);
  if (expect(node.translation, 3, "translation"))
    translation = {node.translation[0], node.translation[1], node.translation[2]};
  if (expect(node.rotation, 4, "rotation"))
    rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
  if (expect(node.scale, 3, "scale")) scale = {node.scale[0], node.scale[1], node.scale[2]};
  return from_parts(translation, rotation, scale);
}

namespace {

/// Whether the last row of a node's matrix is that of an affine transform, but for rounding.
bool is_affine(const GltfNode& node) {
  constexpr double rounding = 1e-3;
  const auto& m = node.matrix;
  return m.size() != 16 || (std::abs(m[3]) < rounding && std::abs(m[7]) < rounding &&
                            std::abs(m[11]) < rounding && std::abs(m[15] - 1) < rounding);
}

bool is_finite(const Affine& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      if (!(std::abs(transform[column][row]) <= max_import_coordinate)) return false;
    }
  }
  return true;
}

/// The transforms of EXT_mesh_gpu_instancing, relative to their node.
std::vector<Affine> instance_transforms(const GltfFile& gltf,
                                        const std::map<std::string, int64_t>& attributes,
                                        const std::string& place) {
  static constexpr std::array names = {"TRANSLATION", "ROTATION", "SCALE"};
  std::array<std::optional<GltfAccessor>, 3> parts;
  std::optional<size_t> count;
  for (size_t i = 0; i < parts.size(); ++i) {
    const auto found = attributes.find(names[i]);
    if (found == attributes.end()) continue;
    parts[i].emplace(gltf, found->second, place);
    parts[i]->load();
    if (parts[i]->components() != (i == 1 ? 4 : 3))
      fail(place, "{} of {} components", names[i], parts[i]->components());
    if (count && *count != parts[i]->count()) fail(place, "instance attributes of different lengths");
    count = parts[i]->count();
  }
  if (!count) fail(place, "instances without a translation, rotation or scale");
  const auto vector = [&](size_t part, size_t i, double otherwise) {
    if (!parts[part]) return glm::dvec3(otherwise);
    return glm::dvec3(parts[part]->component(i, 0), parts[part]->component(i, 1),
                      parts[part]->component(i, 2));
  };
  std::vector<Affine> transforms;
  for (size_t i = 0; i < *count; ++i) {
    glm::dquat rotation(1, 0, 0, 0);
    if (parts[1]) {
      rotation = glm::dquat(parts[1]->component(i, 3), parts[1]->component(i, 0), parts[1]->component(i, 1),
                            parts[1]->component(i, 2));
    }
    transforms.push_back(from_parts(vector(0, i, 0), rotation, vector(2, i, 1)));
  }
  return transforms;
}

std::string node_place(const FileImport& target, size_t node) {
  return fmt::format("{}: node {}", target.place(), node);
}

/// The parent of each node, −1 where it has none. Checks that every node has at most one, and that there are
/// no cycles.
std::vector<int> check_tree(const GltfDocument& gltf, const FileImport& target) {
  std::vector<int> parents(gltf.nodes.size(), -1);
  for (size_t i = 0; i < gltf.nodes.size(); ++i) {
    for (const int64_t child : gltf.nodes[i].children) {
      if (child < 0 || static_cast<size_t>(child) >= parents.size())
        fail(node_place(target, i), "names node {} of {}", child, parents.size());
      int& parent = parents[static_cast<size_t>(child)];
      if (parent != -1) fail(node_place(target, static_cast<size_t>(child)), "has several parents");
      parent = static_cast<int>(i);
    }
  }
  std::vector<int64_t> open;
  for (size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == -1) open.push_back(static_cast<int64_t>(i));
  }
  std::vector<bool> reached(parents.size());
  while (!open.empty()) {
    const auto node = static_cast<size_t>(open.back());
    open.pop_back();
    reached[node] = true;
    open.insert(open.end(), gltf.nodes[node].children.begin(), gltf.nodes[node].children.end());
  }
  for (size_t i = 0; i < reached.size(); ++i) {
    if (!reached[i]) fail(node_place(target, i), "hangs in a cycle of nodes");
  }
  return parents;
}

/// The roots of the scene that is drawn: the default one, or the first one; every node without a parent where
/// the file has no scenes.
std::vector<size_t> scene_roots(const GltfDocument& gltf, const std::vector<int>& parents,
                                FileImport& target) {
  std::vector<size_t> roots;
  if (gltf.scenes.empty() && gltf.default_scene == -1) {
    for (size_t i = 0; i < parents.size(); ++i) {
      if (parents[i] == -1) roots.push_back(i);
    }
    return roots;
  }
  const int64_t scene = std::max<int64_t>(gltf.default_scene, 0);
  if (static_cast<size_t>(scene) >= gltf.scenes.size())
    fail(target.place(), "names scene {} of {}", scene, gltf.scenes.size());
  target.warn("scenes beside the one that is shown first were not imported", gltf.scenes.size() - 1);
  std::vector<bool> named(parents.size());
  for (const int64_t node : gltf.scenes[static_cast<size_t>(scene)]) {
    if (node < 0 || static_cast<size_t>(node) >= parents.size())
      fail(target.place(), "the scene names node {} of {}", node, parents.size());
    const auto root = static_cast<size_t>(node);
    if (parents[root] != -1) fail(node_place(target, root), "is a root of the scene, but has a parent");
    if (named[root]) {
      target.warn("nodes are named twice by their scene; they are placed once");
      continue;
    }
    named[root] = true;
    roots.push_back(root);
  }
  return roots;
}

/// Of every node below the roots the transform to the scene.
std::vector<Affine> global_transforms(const GltfDocument& gltf, const std::vector<int>& parents,
                                      const FileImport& target) {
  std::vector<Affine> globals(gltf.nodes.size(), Affine(1));
  std::vector<size_t> open;
  for (size_t i = 0; i < parents.size(); ++i) {
    if (parents[i] == -1) open.push_back(i);
  }
  while (!open.empty()) {
    const size_t node = open.back();
    open.pop_back();
    const Affine local = gltf_local_transform(gltf.nodes[node], node_place(target, node));
    globals[node] = parents[node] == -1 ? local : compose(globals[static_cast<size_t>(parents[node])], local);
    for (const int64_t child : gltf.nodes[node].children) open.push_back(static_cast<size_t>(child));
  }
  return globals;
}

/// Places the content of a tree of nodes, in the model or in a group.
class Placer {
 public:
  Placer(const GltfFile& gltf, FileImport& target, GltfMeshes& meshes, const GltfGroups& groups,
         GltfMotion& motion, std::vector<Affine> globals, std::vector<SourceObjectId> objects)
      : gltf_(gltf),
        target_(target),
        meshes_(meshes),
        groups_(groups),
        motion_(motion),
        globals_(std::move(globals)),
        objects_(std::move(objects)) {}

  void place_groups() {
    for (size_t group = 0; group < groups_.nodes.size(); ++group) {
      into_ = Group();
      first_object_ = objects_[groups_.nodes[group]];
      uses_ = groups_.uses[group];
      // Depth first from a node that is the group; that node's own transform belongs to the placement.
      walk({{groups_.nodes[group], Affine(1)}}, true);
      const bool empty = into_->instances.empty() && into_->groups.empty();
      numbers_.push_back(empty ? GltfGroups::none : target_.add_group(std::move(*into_)));
    }
    into_.reset();
    first_object_ = 0;
    uses_ = 1;
  }

  void place_scene(const std::vector<size_t>& roots) {
    std::vector<Open> open;
    for (size_t i = roots.size(); i-- > 0;) open.push_back({roots[i], Affine(1)});
    walk(std::move(open), false);
  }

 private:
  struct Open {
    size_t node;
    Affine transform;  ///< of its parent: to the scene, or to the space of what carries it
    uint32_t joint = GltfMotion::rests;
  };

  /// `inside`: the first node is the group that is being made.
  void walk(std::vector<Open> open, bool inside) {
    while (!open.empty()) {  // depth first, in the file's order
      const Open next = open.back();
      open.pop_back();
      const size_t index = next.node;
      Affine transform = next.transform;
      joint_ = next.joint;
      if (!inside) {
        const Affine local = gltf_local_transform(gltf_.model.nodes[index], node_place(target_, index));
        const bool moves = motion_.moves(index);
        if (moves) joint_ = motion_.add_joint(index, next.joint, next.transform);
        transform = moves ? Affine(1) : compose(transform, local);
        if (const uint32_t group = groups_.of_node[index]; group != GltfGroups::none) {
          place_group(group, transform, object_of(index));
          continue;
        }
      }
      inside = false;
      if (!gltf_.model.nodes[index].visible) {
        target_.warn("nodes that the file hides were not imported, nor what is below them", uses_);
        continue;
      }
      if (!is_affine(gltf_.model.nodes[index]))
        target_.warn("nodes have a matrix that is not affine; its last row was left out", uses_);
      place_node(index, transform);
      const auto& children = gltf_.model.nodes[index].children;
      for (size_t i = children.size(); i-- > 0;)
        open.push_back({static_cast<size_t>(children[i]), transform, joint_});
    }
    joint_ = GltfMotion::rests;
  }

  /// That is made, or that what moves carries; null: the model.
  Group* current_group() {
    if (joint_ != GltfMotion::rests) return &motion_.carried_by(joint_);
    return into_ ? &*into_ : nullptr;
  }

  /// Of a node; counted from the group's own that is being made.
  SourceObjectId object_of(size_t node) const {
    return objects_[node] == no_id ? no_id : objects_[node] - first_object_;
  }

  void place_node(size_t index, const Affine& transform) {
    const auto& node = gltf_.model.nodes[index];
    if (node.mesh == -1) return;
    const std::string place = node_place(target_, index);
    if (node.skin >= 0 && place_skinned(node, object_of(index), place)) return;
    const auto mesh = meshes_.mesh(node.mesh, place);
    if (!mesh) return target_.warn("nodes place a mesh without triangles", uses_);
    std::vector<Affine> placements = {Affine(1)};
    if (node.instancing) placements = instance_transforms(gltf_, *node.instancing, place);
    for (const Affine& placement : placements) {
      const Affine placed = compose(transform, placement);
      if (!is_finite(placed)) {
        target_.warn(not_finite, uses_);
      } else if (Group* const group = current_group()) {
        group->instances.push_back({*mesh, placed, object_of(index)});
      } else {
        target_.add_instance(*mesh, placed, object_of(index));
      }
    }
  }

  /// Only its joints move a skinned mesh. Where they all move it alike, which is how most files are at rest,
  /// the mesh stays as it is. False if the skin cannot be read.
  bool place_skinned(const GltfNode& node, SourceObjectId object, const std::string& place) {
    const auto is_carried = [&](int64_t joint) {
      return joint >= 0 && static_cast<size_t>(joint) < gltf_.model.nodes.size() &&
             motion_.is_carried(static_cast<size_t>(joint));
    };
    const auto skin = static_cast<size_t>(node.skin);
    if (skin < gltf_.model.skins.size() && std::ranges::any_of(gltf_.model.skins[skin].joints, is_carried))
      target_.warn("skins are not animated: their meshes stay as their joints are at rest");
    std::vector<Affine> joints;
    std::optional<uint32_t> mesh;
    Affine transform(1);
    try {
      joints = gltf_joint_transforms(gltf_, node.skin, globals_, place);
      if (joints.empty() || !meshes_.has_joints(node.mesh)) return false;
      const bool alike = std::all_of(joints.begin(), joints.end(),
                                     [&](const Affine& joint) { return are_close(joint, joints.front()); });
      if (alike) transform = joints.front();
      mesh =
          alike ? meshes_.mesh(node.mesh, place) : meshes_.skinned_mesh(node.mesh, joints, node.skin, place);
    } catch (const Error& error) {
      target_.warn("skins cannot be read; their meshes are placed by their nodes");
      return false;
    }
    if (mesh && is_finite(transform)) {
      target_.add_instance(*mesh, transform, object);
    } else {
      target_.warn(mesh ? not_finite : "nodes place a mesh without triangles");
    }
    return true;
  }

  static bool are_close(const Affine& a, const Affine& b) {
    double size = 0, distance = 0;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 3; ++row) {
        size = std::max(size, std::abs(b[column][row]));
        distance = std::max(distance, std::abs(a[column][row] - b[column][row]));
      }
    }
    return distance <= 1e-5 * size;
  }

  void place_group(uint32_t group, const Affine& transform, SourceObjectId first_object) {
    const uint32_t number = numbers_[group];
    if (number == GltfGroups::none) return;
    if (!is_finite(transform)) {
      target_.warn(not_finite, uses_ * groups_.placements[group]);
    } else if (Group* const around = current_group()) {
      around->groups.push_back({number, transform, first_object});
    } else {
      target_.add_group_instance(number, transform, first_object);
    }
  }

  static constexpr const char* not_finite = "placements were dropped: their transforms are not finite";

  const GltfFile& gltf_;
  FileImport& target_;
  GltfMeshes& meshes_;
  const GltfGroups& groups_;
  GltfMotion& motion_;
  uint32_t joint_ = GltfMotion::rests;   ///< what carries the node that is placed
  std::vector<Affine> globals_;          ///< of every node to the scene, if there are skins
  std::vector<SourceObjectId> objects_;  ///< of every node
  SourceObjectId first_object_ = 0;      ///< what objects of the current content count from
  std::optional<Group> into_;            ///< nullopt: the model
  uint64_t uses_ = 1;                    ///< how many places in the scene the current content has
  std::vector<uint32_t> numbers_;        ///< of groups in the model
};

}  // namespace

void place_gltf_nodes(const GltfFile& gltf, FileImport& target, GltfMeshes& meshes) {
  const std::vector<int> parents = check_tree(gltf.model, target);
  const std::vector<size_t> roots = scene_roots(gltf.model, parents, target);
  add_gltf_lights(gltf.model, roots, target);
  GltfMotion motion(gltf, target);
  const GltfGroups groups = find_gltf_groups(gltf.model, roots, motion, target.options());
  std::vector<Affine> globals;
  if (!gltf.model.skins.empty()) globals = global_transforms(gltf.model, parents, target);
  Placer placer(gltf, target, meshes, groups, motion, std::move(globals),
                add_gltf_objects(gltf.model, roots, groups, target));
  placer.place_groups();
  placer.place_scene(roots);
  motion.place_groups();
}

void import_gltf(FileImport& target) {
  target.says_up(UpAxis::y);
  target.says_unit(LengthUnit::metre);
  import_gltf(target, target.content());
}

void import_gltf(FileImport& target, std::shared_ptr<const StreamSource> source) {
  const GltfFile gltf = load_gltf(target, source);
  for (const GltfBuffer& buffer : gltf.buffers) {
    if (buffer.source && buffer.source != source && buffer.source->has_file())
      target.also_reads(buffer.source->name());
  }
  GltfMeshes meshes(gltf, target);
  place_gltf_nodes(gltf, target, meshes);
  target.warn("meshes are placed nowhere in the scene and were not imported", meshes.unused_count());
}

}  // namespace triptych
