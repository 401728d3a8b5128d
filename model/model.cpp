#include "model/model.hpp"

namespace triptych {

uint64_t Mesh::triangle_count() const { return stream ? stream->triangle_count() : triangles.size(); }

std::string Model::name() const { return files.empty() ? "the model" : files.front().string(); }

uint64_t Model::source_triangles() const {
  uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangle_count();
  return count;
}

uint64_t Model::placed_triangles() const {
  uint64_t count = 0;
  for (const Instance& instance : instances) count += meshes[instance.mesh].triangle_count();
  return count;
}

}  // namespace triptych
