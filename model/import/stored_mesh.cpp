#include "model/import/stored_mesh.hpp"

#include "base/bytes.hpp"
#include "model/read_mesh.hpp"

namespace triptych {

StoredMesh::StoredMesh(std::shared_ptr<SpoolFile> file, const Mesh& mesh)
    : vertices_(mesh.positions.size()),
      triangles_(mesh.triangles.size()),
      has_colors_(mesh.has_colors()),
      has_normals_(mesh.has_normals()),
      has_coordinates_(mesh.has_coordinates()) {
  ByteWriter writer;
  writer.write_all(std::span<const glm::dvec3>(mesh.positions));
  writer.write_all(std::span<const Triangle>(mesh.triangles));
  writer.write_all(std::span<const VertexColor>(mesh.colors));
  writer.write_all(std::span<const VertexNormal>(mesh.normals));
  writer.write_all(std::span<const TextureCoordinates>(mesh.coordinates));
  place_ = file->append(writer.bytes());
  file_ = std::move(file);
}

std::shared_ptr<const Mesh> StoredMesh::load() const {
  const std::vector<std::byte> bytes = file_->read(place_);
  ByteReader reader(bytes, file_->path().string());
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = reader.read_all<glm::dvec3>(vertices_);
  mesh->triangles = reader.read_all<Triangle>(triangles_);
  if (has_colors_) mesh->colors = reader.read_all<VertexColor>(vertices_);
  if (has_normals_) mesh->normals = reader.read_all<VertexNormal>(vertices_);
  if (has_coordinates_) mesh->coordinates = reader.read_all<TextureCoordinates>(vertices_);
  return mesh;
}

uint64_t StoredMesh::read(const TakeTriangles& take) const { return read_mesh(*load(), take); }

uint64_t held_triangles(const Mesh& mesh) {
  const auto* stored = dynamic_cast<const StoredMesh*>(mesh.stream.get());
  return stored ? stored->triangle_count() : mesh.triangles.size();
}

uint64_t held_bytes(const Mesh& mesh) {
  return mesh.positions.capacity() * sizeof(glm::dvec3) + mesh.triangles.capacity() * sizeof(Triangle) +
         mesh.colors.capacity() * sizeof(VertexColor) + mesh.normals.capacity() * sizeof(VertexNormal) +
         mesh.coordinates.capacity() * sizeof(TextureCoordinates);
}

}  // namespace triptych
