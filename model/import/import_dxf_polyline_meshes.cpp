// POLYLINE as a polygon mesh (rows and columns of vertices) or as a polyface mesh (faces over vertices).
#include "model/import/import_dxf.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace triptych {

namespace {

constexpr int64_t closed_in_rows = 1, smoothed = 4, polygon_mesh = 16, closed_in_columns = 32,
                  polyface_mesh = 64;
constexpr int64_t control_point = 16, mesh_vertex = 64, polyface_vertex = 128;

glm::dvec3 position_of(const DxfRecord& vertex) {
  return {vertex.coordinate(10), vertex.coordinate(20), vertex.coordinate(30)};
}

void add_polygon_mesh(const DxfRecord& entity, std::span<const DxfRecord> vertices, const DxfStyle& style,
                      DxfSurfaces& surfaces) {
  const int64_t flags = entity.integer(70);
  // A smoothed mesh holds its control points too, and has a size of its own.
  const bool smooth = (flags & smoothed) != 0;
  const auto rows = static_cast<uint64_t>(std::clamp<int64_t>(entity.integer(smooth ? 73 : 71), 0, 1 << 20));
  const auto columns =
      static_cast<uint64_t>(std::clamp<int64_t>(entity.integer(smooth ? 74 : 72), 0, 1 << 20));
  std::vector<uint32_t> numbers;
  for (const DxfRecord& vertex : vertices) {
    if (!smooth || (vertex.integer(70) & control_point) == 0)
      numbers.push_back(surfaces.add_vertex(position_of(vertex)));
  }
  if (rows < 2 || columns < 2 || rows * columns > numbers.size())
    return surfaces.target().warn("polygon meshes without the vertices that they promise were skipped");
  const uint64_t last_row = (flags & closed_in_rows) != 0 ? rows : rows - 1;
  const uint64_t last_column = (flags & closed_in_columns) != 0 ? columns : columns - 1;
  for (uint64_t i = 0; i < last_row; ++i) {
    for (uint64_t k = 0; k < last_column; ++k) {
      const auto at = [&](uint64_t row, uint64_t column) {
        return numbers[row % rows * columns + column % columns];
      };
      surfaces.add_face(std::array{at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)}, style);
    }
  }
}

/// Faces name vertices from 1; a negative number hides the edge that begins there, and is a corner all the
/// same. Layer and colour may be a face's own.
void add_polyface_mesh(std::span<const DxfRecord> vertices, const DxfStyle& style, DxfSurfaces& surfaces) {
  std::vector<uint32_t> numbers, corners;
  for (const DxfRecord& vertex : vertices) {
    if ((vertex.integer(70) & mesh_vertex) != 0) numbers.push_back(surfaces.add_vertex(position_of(vertex)));
  }
  for (const DxfRecord& face : vertices) {
    if ((face.integer(70) & (mesh_vertex | polyface_vertex)) != polyface_vertex) continue;
    corners.clear();
    bool there = true;
    for (int code = 71; code <= 74; ++code) {
      const auto number = static_cast<uint64_t>(std::abs(face.integer(code)));
      if (number == 0) continue;
      there = there && number <= numbers.size();
      if (there) corners.push_back(numbers[number - 1]);
    }
    if (!there) {
      surfaces.target().warn("faces that name vertices which are not there were skipped");
    } else if (corners.size() >= 3) {
      surfaces.add_face(corners, surfaces.style_of(face, style));
    } else {
      surfaces.target().warn("edges and points of polyface meshes were skipped");
    }
  }
}

}  // namespace

bool add_dxf_polyline_mesh(const DxfRecord& entity, std::span<const DxfRecord> vertices,
                           const DxfStyle& style, DxfSurfaces& surfaces) {
  if (entity.type != "POLYLINE") return false;
  const int64_t flags = entity.integer(70);
  if ((flags & polyface_mesh) != 0) {
    add_polyface_mesh(vertices, style, surfaces);
  } else if ((flags & polygon_mesh) != 0) {
    add_polygon_mesh(entity, vertices, style, surfaces);
  } else {
    return false;
  }
  return true;
}

}  // namespace triptych
