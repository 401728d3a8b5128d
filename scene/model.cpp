#include "scene/model.hpp"

namespace triptych {

uint64_t Model::source_triangles() const {
  uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

uint64_t Model::placed_triangles() const {
  uint64_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].triangles.size();
  return count;
}

}  // namespace triptych
