#include "raster/geometry_stage.hpp"

#include "raster/clip.hpp"

#include <algorithm>

namespace triptych {

namespace {

struct StageVertex {
  WindowVertex window;
  float slack;     ///< behind the bounds of its piece
  bool is_inside;  ///< of the planes that triangles are clipped at; elsewhere the others hold nothing
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

void add_clipped(const GeometryTerms& terms, const std::array<ClipCorner, 3>& corners, uint32_t slot,
                 const PixelDepthBound& bound, StretchTriangles& result) {
  const ClippedPolygon polygon = clip_triangle(corners, terms.window);
  for (size_t i = 2; i < polygon.count; ++i) {
    const std::array<WindowVertex, 3> window = {polygon.corners[0], polygon.corners[i - 1],
                                                polygon.corners[i]};
    WindowTriangle triangle;
    if (!set_up(window, terms.limits, triangle)) continue;
    triangle.slot = slot;
    hold_to(bound, std::min({slack(bound, window[0]), slack(bound, window[1]), slack(bound, window[2])}),
            triangle);
    add(triangle, result);
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

[[gnu::noinline]] void make_triangles(const GeometryTerms& terms, const DrawnRange& range,
                                      std::span<const LatticeBox> pieces, StretchTriangles& result) {
  result.triangles.clear();
  result.bounds.clear();
  result.bottom = 0;
  result.top = -1;
  for (const LatticeBox& piece : pieces) result.bounds.push_back(terms.projector->pixel_bound(piece));
  const RasterChunk& chunk = *range.chunk;
  static thread_local std::vector<StageVertex> vertices;
  vertices.resize(chunk.x.size());
  for (size_t i = 0; i < chunk.x.size(); ++i) {
    const glm::vec4 position = terms.to_clip<glm::vec4>(range.placed, chunk, i);
    StageVertex& vertex = vertices[i];
    vertex.is_inside = terms.window.is_inside(position);
    if (!vertex.is_inside) continue;
    vertex.window = terms.window.apply(position);
    vertex.slack = slack(result.bounds[chunk.piece[i]], vertex.window);
  }
  for (uint32_t i = 0; i < range.triangle_count; ++i) {
    const uint32_t* corners = &chunk.corners[3 * size_t{range.first_triangle + i}];
    const StageVertex &a = vertices[corners[0]], &b = vertices[corners[1]], &c = vertices[corners[2]];
    const PixelDepthBound& bound = result.bounds[chunk.piece[corners[0]]];
    if (!(a.is_inside && b.is_inside && c.is_inside)) {
      std::array<ClipCorner, 3> positions;
      for (size_t k = 0; k < 3; ++k) {
        positions[k] = {terms.to_clip<glm::vec4>(range.placed, chunk, corners[k]),
                        terms.to_clip<glm::dvec4>(range.placed, chunk, corners[k])};
      }
      add_clipped(terms, positions, range.first_slot + i, bound, result);
      continue;
    }
    const std::array<WindowVertex, 3> window = {a.window, b.window, c.window};
    WindowTriangle triangle;
    if (!set_up(window, terms.limits, triangle)) continue;
    triangle.slot = range.first_slot + i;
    hold_to(bound, std::min({a.slack, b.slack, c.slack}), triangle);
    add(triangle, result);
  }
}

}  // namespace triptych
