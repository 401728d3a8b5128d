#include "raster/geometry_stage.hpp"

#include "raster/clip.hpp"
#include "raster/instruction_set.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// The vertices of a chunk in the window: WindowPoints with room.
struct StageVertices {
  std::vector<int32_t> x, y;
  std::vector<float> depth;
  std::vector<int32_t> inside;

  void resize(size_t count) {
    x.resize(count);
    y.resize(count);
    depth.resize(count);
    inside.resize(count);
  }
  WindowPoints points() { return {x.data(), y.data(), depth.data(), inside.data()}; }
  WindowVertex operator[](uint32_t i) const { return {x[i], y[i], depth[i]}; }
};

/// Of corners that are so far behind the bound, at least. Where all of them are behind each plane by more
/// than the depth may be off, so is what lies between them.
void hold_to(const PixelDepthBound& bound, float least_slack, WindowTriangle& triangle) {
  if (!(least_slack >= triangle.error)) triangle.bound = &bound;
}

void add(const WindowTriangle& triangle, StretchTriangles& result) {
  if (result.triangles.empty()) {
    result.bottom = triangle.bottom;
    result.top = triangle.top;
  }
  result.bottom = std::min(result.bottom, triangle.bottom);
  result.top = std::max(result.top, triangle.top);
  result.triangles.push_back(triangle);
}

void add_window(const GeometryTerms& terms, const std::array<WindowVertex, 3>& window, uint32_t slot,
                const PixelDepthBound& bound, StretchTriangles& result) {
  WindowTriangle triangle;
  if (!set_up(window, terms.limits, triangle)) return;
  triangle.slot = slot;
  hold_to(bound, std::min({slack(bound, window[0]), slack(bound, window[1]), slack(bound, window[2])}),
          triangle);
  add(triangle, result);
}

void add_clipped(const GeometryTerms& terms, const std::array<ClipCorner, 3>& corners, uint32_t slot,
                 const PixelDepthBound& bound, StretchTriangles& result) {
  const ClippedPolygon polygon = clip_triangle(corners, terms.window);
  for (size_t i = 2; i < polygon.count; ++i) {
    const std::array<WindowVertex, 3> window = {polygon.corners[0], polygon.corners[i - 1],
                                                polygon.corners[i]};
    add_window(terms, window, slot, bound, result);
  }
}

}  // namespace

GeometryTerms::GeometryTerms(const FrameView& view, const BoxProjector& of_view)
    : projector(&of_view),
      clip(clip_terms(view)),
      orthographic(view.clip.orthographic),
      window(view.view().width, view.view().height),
      limits{view.view().width, view.view().height} {}

template <typename Position>
Position GeometryTerms::to_clip(const PlacedLattice& placed, const RasterChunk& chunk, size_t vertex) const {
  using Number = typename Position::value_type;
  // Integers are added exactly and converted once: shared vertices come out bit-equal whichever chunk brings
  // them.
  const auto x = static_cast<Number>(chunk.x[vertex] + placed.cell.x),
             y = static_cast<Number>(chunk.y[vertex] + placed.cell.y),
             z = static_cast<Number>(chunk.z[vertex] + placed.cell.z);
  const auto along = [&](const glm::vec4& row) { return ((row.x * x + row.y * y) + row.z * z) + row.w; };
  const Number eye_x = along(placed.rows[0]), eye_y = along(placed.rows[1]), eye_z = along(placed.rows[2]);
  if (orthographic) {
    return {clip.frustum.x * eye_x + clip.frustum.z, clip.frustum.y * eye_y + clip.frustum.w,
            clip.depth.x * eye_z + clip.depth.y, 1};
  }
  return {clip.frustum.x * eye_x + clip.frustum.z * eye_z, clip.frustum.y * eye_y + clip.frustum.w * eye_z,
          clip.depth.x, -eye_z};
}

TransformTerms GeometryTerms::transform_terms(const PlacedLattice& placed) const {
  TransformTerms terms{.rows = {},
                       .cell = {placed.cell.x, placed.cell.y, placed.cell.z},
                       .frustum = {clip.frustum.x, clip.frustum.y, clip.frustum.z, clip.frustum.w},
                       .depth = {clip.depth.x, clip.depth.y},
                       .orthographic = orthographic,
                       .scale_x = window.scale_x(),
                       .scale_y = window.scale_y(),
                       .guard_x = window.guard_x(),
                       .guard_y = window.guard_y(),
                       .middle_x = window.middle_x(),
                       .middle_y = window.middle_y()};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) terms.rows[row][column] = placed.rows[row][column];
  }
  return terms;
}

namespace {

void transform_vertices(const GeometryTerms& terms, const PlacedLattice& placed, const RasterChunk& chunk,
                        StageVertices& vertices) {
  const size_t count = chunk.x.size();
  vertices.resize(count);
  size_t first = 0;
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    first = static_cast<size_t>(kernels->transform_vertices(terms.transform_terms(placed),
                                                            {chunk.x.data(), chunk.y.data(), chunk.z.data()},
                                                            static_cast<int32_t>(count), vertices.points()));
  }
  for (size_t i = first; i < count; ++i) {
    const auto position = terms.to_clip<glm::vec4>(placed, chunk, i);
    vertices.inside[i] = terms.window.is_inside(position) ? -1 : 0;
    if (!vertices.inside[i]) continue;
    const WindowVertex vertex = terms.window.apply(position);
    vertices.x[i] = vertex.x;
    vertices.y[i] = vertex.y;
    vertices.depth[i] = vertex.depth;
  }
}

}  // namespace

[[gnu::noinline]] void make_triangles(const GeometryTerms& terms, const DrawnRange& range,
                                      std::span<const LatticeBox> pieces, StretchTriangles& result) {
  result.triangles.clear();
  result.bounds.clear();
  result.bottom = 0;
  result.top = -1;
  for (const LatticeBox& piece : pieces) result.bounds.push_back(terms.projector->pixel_bound(piece));
  const RasterChunk& chunk = *range.chunk;
  static thread_local StageVertices vertices;
  transform_vertices(terms, range.placed, chunk, vertices);
  for (uint32_t i = 0; i < range.triangle_count; ++i) {
    const uint32_t* corners = &chunk.corners[3 * size_t{range.first_triangle + i}];
    const PixelDepthBound& bound = result.bounds[chunk.piece[corners[0]]];
    if (!(vertices.inside[corners[0]] & vertices.inside[corners[1]] & vertices.inside[corners[2]])) {
      std::array<ClipCorner, 3> positions;
      for (size_t k = 0; k < 3; ++k) {
        positions[k] = {terms.to_clip<glm::vec4>(range.placed, chunk, corners[k]),
                        terms.to_clip<glm::dvec4>(range.placed, chunk, corners[k])};
      }
      add_clipped(terms, positions, range.first_slot + i, bound, result);
      continue;
    }
    const std::array<WindowVertex, 3> window = {vertices[corners[0]], vertices[corners[1]],
                                                vertices[corners[2]]};
    if (pixel_box(window, terms.limits).empty()) continue;  // most of them
    add_window(terms, window, range.first_slot + i, bound, result);
  }
}

}  // namespace triptych
