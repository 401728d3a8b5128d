#include "model/read_mesh.hpp"

#include <algorithm>
#include <vector>

namespace triptych {

uint64_t read_mesh(const Mesh& mesh, const TakeTriangles& take) {
  if (mesh.stream) return mesh.stream->read(take);
  constexpr size_t batch = 4096;
  std::vector<CornerTriangle> triangles;
  triangles.reserve(std::min(batch, mesh.triangles.size()));
  for (const Triangle& triangle : mesh.triangles) {
    triangles.push_back({{mesh.positions[triangle.vertices[0]], mesh.positions[triangle.vertices[1]],
                          mesh.positions[triangle.vertices[2]]},
                         triangle.material});
    if (!mesh.colors.empty()) {
      for (size_t i = 0; i < 3; ++i) triangles.back().colors[i] = mesh.colors[triangle.vertices[i]];
    }
    if (!mesh.normals.empty()) {
      for (size_t i = 0; i < 3; ++i) triangles.back().normals[i] = mesh.normals[triangle.vertices[i]];
    }
    if (!mesh.coordinates.empty()) {
      for (size_t i = 0; i < 3; ++i) triangles.back().coordinates[i] = mesh.coordinates[triangle.vertices[i]];
    }
    if (!mesh.light.empty()) {
      for (size_t i = 0; i < 3; ++i) triangles.back().light[i] = mesh.light[triangle.vertices[i]];
    }
    if (triangles.size() == batch) {
      take(triangles);
      triangles.clear();
    }
  }
  if (!triangles.empty()) take(triangles);
  return 0;
}

}  // namespace triptych
