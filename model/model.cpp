#include "model/model.hpp"

namespace triptych {

uint64_t Mesh::triangle_count() const { return stream ? stream->triangle_count() : triangles.size(); }

bool Mesh::has_colors() const { return stream ? stream->has_colors() : !colors.empty(); }
bool Mesh::has_normals() const { return stream ? stream->has_normals() : !normals.empty(); }

bool Mesh::has_coordinates() const { return stream ? stream->has_coordinates() : !coordinates.empty(); }

std::string Model::name() const { return files.empty() ? "the model" : files.front().string(); }

uint64_t Model::source_triangles() const {
  uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangle_count();
  return count;
}

uint64_t Model::placed_triangles() const {
  std::vector<uint64_t> of_groups;
  const auto count = [&](const std::vector<Instance>& meshes_placed,
                         const std::vector<GroupInstance>& groups_placed) {
    uint64_t triangles = 0;
    for (const Instance& instance : meshes_placed) triangles += meshes[instance.mesh].triangle_count();
    for (const GroupInstance& instance : groups_placed) triangles += of_groups[instance.group];
    return triangles;
  };
  for (const Group& group : groups) of_groups.push_back(count(group.instances, group.groups));
  return count(instances, group_instances);
}

}  // namespace triptych
