// Geometry that is too large for memory: it stays in its file and is read batch by batch, as often as it is
// needed.
#pragma once

#include "scene/texture.hpp"
#include "scene/vertex_color.hpp"
#include "scene/vertex_light.hpp"
#include "scene/vertex_normal.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace triptych {

/// A triangle by its corners, mesh space; finite. The material is an index into the model's.
struct CornerTriangle {
  std::array<glm::dvec3, 3> corners;
  uint32_t material;
  CornerColors colors = {};            ///< as Mesh::colors; of streams without colours all zero
  CornerNormals normals = {};          ///< as Mesh::normals; of streams without normals all zero
  CornerCoordinates coordinates = {};  ///< as Mesh::coordinates
  CornerLight light = {};              ///< as Mesh::light; of streams all zero
  bool operator==(const CornerTriangle&) const = default;
};

struct Mesh;

/// Takes a batch; the span is valid during the call only.
using TakeTriangles = std::function<void(std::span<const CornerTriangle>)>;

/// The triangles of one mesh, in their file. Reading takes memory that does not depend on the file's size.
class MeshStream {
 public:
  virtual ~MeshStream() = default;

  /// After triangulation of n-gons, before anything is dropped: exact, or as declared by the file.
  virtual uint64_t triangle_count() const = 0;

  /// Whether vertices have colours.
  virtual bool has_colors() const { return false; }
  virtual bool has_normals() const { return false; }  ///< the same of shading normals
  /// Whether any of them has a place on a texture.
  virtual bool has_coordinates() const { return false; }

  /// Calls take with batches of some thousands of triangles in the file's order; the same triangles in the
  /// same order each time. Returns how many were dropped: their coordinates are not finite. Several threads
  /// may read at once. Error (file and place in it) for damage: an index out of range, a file cut or changed
  /// since it was opened. What take throws passes through.
  virtual uint64_t read(const TakeTriangles& take) const = 0;

  /// The mesh with its vertices, if it was once in memory and was stored; null for other streams.
  virtual std::shared_ptr<const Mesh> load() const { return nullptr; }

  /// What else the last complete read left out, "<file>: <count> <what>" each; empty before that.
  virtual std::vector<std::string> warnings() const { return {}; }
};

}  // namespace triptych
