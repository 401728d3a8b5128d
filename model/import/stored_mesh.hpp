// Meshes that were read but are not kept in memory: they are stored in a temporary file with their vertices.
#pragma once

#include "base/spool_file.hpp"
#include "model/model.hpp"

#include <memory>

namespace triptych {

/// A mesh in a spool file, which may hold others too. load() returns it as it was in memory.
class StoredMesh : public MeshStream {
 public:
  /// Appends the mesh to the file.
  StoredMesh(std::shared_ptr<SpoolFile> file, const Mesh& mesh);

  uint64_t triangle_count() const override { return triangles_; }
  bool has_colors() const override { return has_colors_; }
  bool has_normals() const override { return has_normals_; }
  bool has_coordinates() const override { return has_coordinates_; }
  uint64_t read(const TakeTriangles& take) const override;
  std::shared_ptr<const Mesh> load() const override;

 private:
  std::shared_ptr<const SpoolFile> file_;
  uint64_t vertices_, triangles_;
  bool has_colors_, has_normals_, has_coordinates_;
  SpoolPlace place_;  ///< positions, triangles, and colours, normals and texture coordinates if there are any
};

/// Triangles of a mesh that is held in memory, or stored; 0 for those that stay in the model's file.
uint64_t held_triangles(const Mesh& mesh);

/// Bytes that a mesh takes in memory.
uint64_t held_bytes(const Mesh& mesh);

}  // namespace triptych
