// Skins of glTF: vertices that several joints move, as these stand at rest (glTF 2.0, 3.7.3).
#include "base/error.hpp"
#include "model/import/import_gltf.hpp"

#include <array>
#include <glm/mat4x4.hpp>

namespace triptych {

std::vector<Affine> gltf_joint_transforms(const GltfFile& gltf, int64_t index,
                                          const std::vector<Affine>& globals, const std::string& place) {
  if (index < 0 || static_cast<size_t>(index) >= gltf.model.skins.size())
    fail(place, "names skin {} of {}", index, gltf.model.skins.size());
  const GltfSkin& skin = gltf.model.skins[static_cast<size_t>(index)];
  std::optional<GltfAccessor> inverse;
  if (skin.inverse_bind_matrices >= 0) {
    inverse.emplace(gltf, skin.inverse_bind_matrices, place);
    if (inverse->components() != 16 || inverse->count() < skin.joints.size())
      fail(place, "skin {} lacks inverse bind matrices", index);
    inverse->load();
  }
  std::vector<Affine> joints;
  for (size_t i = 0; i < skin.joints.size(); ++i) {
    const int64_t node = skin.joints[i];
    if (node < 0 || static_cast<size_t>(node) >= globals.size())
      fail(place, "skin {} names node {} of {}", index, node, globals.size());
    Affine from_mesh(1);
    for (int column = 0; inverse && column < 4; ++column) {
      for (int row = 0; row < 3; ++row) from_mesh[column][row] = inverse->component(i, column * 4 + row);
    }
    joints.push_back(globals[static_cast<size_t>(node)] * glm::dmat4(from_mesh));
  }
  return joints;
}

GltfMeshes::Move GltfMeshes::skinning(const Part& part, const std::vector<Affine>& joints) {
  struct Influences {
    GltfAccessor joints, weights;
  };
  std::vector<Influences> sets;
  const auto& attributes = part.primitive->attributes;
  for (int set = 0;; ++set) {
    const auto of_joints = attributes.find(fmt::format("JOINTS_{}", set));
    const auto of_weights = attributes.find(fmt::format("WEIGHTS_{}", set));
    if (of_joints == attributes.end() || of_weights == attributes.end()) break;
    Influences influences{GltfAccessor(gltf_, of_joints->second, part.triangles.place),
                          GltfAccessor(gltf_, of_weights->second, part.triangles.place)};
    for (GltfAccessor* accessor : {&influences.joints, &influences.weights}) {
      if (accessor->components() != 4 || accessor->count() < part.triangles.vertex_count)
        fail(part.triangles.place, "joints or weights do not fit the positions");
      accessor->load();
    }
    sets.push_back(std::move(influences));
  }
  return [sets = std::move(sets), joints](uint32_t vertex, const glm::dvec3& position) {
    glm::dvec3 moved{0};
    double sum = 0;
    for (const Influences& set : sets) {
      for (int i = 0; i < 4; ++i) {
        const double weight = set.weights.component(vertex, i), joint = set.joints.component(vertex, i);
        if (!(weight > 0) || !(joint >= 0 && joint < static_cast<double>(joints.size()))) continue;
        moved += weight * (joints[static_cast<size_t>(joint)] * glm::dvec4(position, 1));
        sum += weight;
      }
    }
    return sum > 0 ? moved / sum : position;
  };
}

}  // namespace triptych
