#include "samples/services/object_scene.hpp"

#include "samples/services/hospital_plan.hpp"

#include <limits>

namespace triptych {

ObjectScene::ObjectScene(GltfWriter& gltf, int storeys)
    : gltf_(gltf), obstacles_(static_cast<size_t>(storeys)) {}

ObjectScene::Written& ObjectScene::written(const std::string& mesh, const MakeMesh& make) {
  const auto [found, added] = meshes_.try_emplace(mesh);
  Written& result = found->second;
  if (!added) return result;
  const MeshParts parts = make();
  result.low = glm::dvec3(std::numeric_limits<double>::max());
  result.high = -result.low;
  for (const MeshPart& part : parts) {
    result.triangles += part.indices.size() / 3;
    for (const glm::dvec3 position : part.positions) {
      result.low = glm::min(result.low, position);
      result.high = glm::max(result.high, position);
    }
  }
  result.number = gltf_.add_mesh(mesh, parts);
  return result;
}

void ObjectScene::place(int storey, const std::string& place, const std::string& mesh, const MakeMesh& make,
                        const glm::dmat4& transform, Footprint footprint) {
  Written& object = written(mesh, make);
  ++object.uses;
  triangles_.push_back(object.triangles);
  gltf_.add_node(place + " " + mesh, object.number, transform);
  if (footprint == Footprint::none) return;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 local(corner & 1 ? object.low.x : object.high.x,
                           corner & 2 ? object.low.y : object.high.y,
                           corner & 4 ? object.low.z : object.high.z);
    const glm::dvec3 at(transform * glm::dvec4(local, 1));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  constexpr double step_over = 0.06, head = 1.95;
  const double level = hospital_level(storey);
  if (high.y > level + step_over && low.y < level + head) block(storey, {low.x, low.z, high.x, high.z});
}

std::vector<uint64_t> ObjectScene::uses_of_meshes() const {
  std::vector<uint64_t> uses;
  for (const auto& [name, mesh] : meshes_) uses.push_back(mesh.uses);
  return uses;
}

uint64_t ObjectScene::unique_triangles() const {
  uint64_t sum = 0;
  for (const auto& [name, mesh] : meshes_) sum += mesh.triangles;
  return sum;
}

void Placer::put(const std::string& mesh, const MakeMesh& make, const glm::dmat4& transform,
                 Footprint footprint) const {
  glm::dmat4 lifted = transform;
  lifted[3].y += hospital_level(storey);
  scene.place(storey, place, mesh, make, lifted, footprint);
}

}  // namespace triptych
