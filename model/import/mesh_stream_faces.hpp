// Faces of any number of corners, in binary records with a list each, as a stream: PLY files, and our own
// temporary files.
#pragma once

#include "model/import/import_ply_header.hpp"
#include "model/mesh_stream.hpp"

#include <atomic>

namespace triptych {

/// Colours of faces, as displayed: which properties hold red, green and blue, before or behind the corners.
struct FaceColors {
  std::array<size_t, 3> properties{};
  glm::dvec3 scale{1};  ///< what values are multiplied by to be from 0 to 1
};

/// Where the faces are in their file, and how they are written.
struct FaceTable {
  std::shared_ptr<const StreamSource> source;
  PlyElement element;
  size_t list = 0;                 ///< the property that holds the corners
  std::optional<size_t> material;  ///< the property that holds the model's material, an uint32
  std::optional<FaceColors> colors = std::nullopt;  ///< then vertices have none
  /// The list, before that of the corners, that holds a VertexNormal of each, in 32 bits; or it is empty.
  std::optional<size_t> normals = std::nullopt;
  /// The same of the list that holds the TextureCoordinates of each corner, in 64 bits.
  std::optional<size_t> places = std::nullopt;
  uint64_t begin = 0, end = 0;  ///< bytes; the last face may end before
  bool end_known = false;       ///< whether the last face must end there
  bool swapped = false;         ///< in the other byte order
};

class FaceStream : public MeshStream {
 public:
  /// colors, normals: of the vertices.
  FaceStream(PositionTable vertices, FaceTable faces, std::optional<ColorTable> colors = std::nullopt,
             std::optional<PositionTable> normals = std::nullopt);

  uint64_t triangle_count() const override { return triangle_count_; }
  bool has_colors() const override { return colors_ || faces_.colors; }
  bool has_normals() const override { return normals_ || faces_.normals; }
  bool has_coordinates() const override { return faces_.places.has_value(); }
  uint64_t read(const TakeTriangles& take) const override;
  std::vector<std::string> warnings() const override;

 private:
  PositionTable vertices_;
  FaceTable faces_;
  std::optional<ColorTable> colors_;
  std::optional<PositionTable> normals_;
  uint64_t triangle_count_;
  mutable std::atomic<uint64_t> dropped_{0}, skipped_faces_{0}, fans_{0}, trailing_bytes_{0};
};

}  // namespace triptych
