#include "raster/geometry_stage.hpp"

#include "raster/clip.hpp"
#include "raster/exact_plane.hpp"
#include "raster/instruction_set.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Vertices of a chunk in the window, and which of its triangles may be seen. Keeps its room.
struct Stage {
  std::vector<int32_t> x, y;
  std::vector<float> depth;
  std::vector<uint32_t> candidates;

  void make_room(size_t vertex_count, size_t triangle_count) {
    const auto grow = [](auto& values, size_t count) {
      if (values.size() < count) values.resize(count);
    };
    grow(x, vertex_count + spare_vertices);
    grow(y, vertex_count + spare_vertices);
    grow(depth, vertex_count + spare_vertices);
    grow(candidates, triangle_count + spare_vertices);
  }
  WindowPoints from(size_t vertex) { return {x.data() + vertex, y.data() + vertex, depth.data() + vertex}; }
  WindowVertex operator[](uint32_t i) const { return {x[i], y[i], depth[i]}; }
};

/// Wider ones are filled first, and hide many of the others.
constexpr int32_t large_width = 16;  // pixels

/// Of corners that are so far behind the limit, at least. Where all of them are behind each plane by more
/// than the depth may be off, so is what lies between them.
void hold_to(const DepthLimit& limit, float least_slack, WindowTriangle& triangle) {
  if (!(least_slack >= triangle.error)) triangle.limit = &limit;
}

void add_rows(int32_t bottom, int32_t top, StretchTriangles& result) {
  const bool first = result.bottom > result.top;
  result.bottom = first ? bottom : std::min(result.bottom, bottom);
  result.top = first ? top : std::max(result.top, top);
}

/// What a triangle has besides its corners.
struct Drawn {
  uint32_t slot;
  uint32_t layer;
  uint32_t cut;
  const SurfaceTexture* texture = nullptr;  ///< where it has holes
  ExactPlane plane = {};                    ///< where layer > 0
};

void add(const GeometryTerms& terms, const WindowTriangle& triangle, const SurfaceTexture* texture,
         StretchTriangles& result) {
  add_rows(triangle.bottom, triangle.top, result);
  if (texture != nullptr) {
    result.cut_out.push_back({triangle, *texture, terms.textures, terms.sample});
    return;
  }
  (triangle.right - triangle.left < large_width ? result.small : result.large).push_back(triangle);
}

void add_window(const GeometryTerms& terms, std::array<WindowVertex, 3> window, const Drawn& drawn,
                const DepthLimit& limit, StretchTriangles& result) {
  WindowTriangle triangle;
  if (drawn.layer > 0) {
    for (WindowVertex& corner : window) corner.depth = drawn.plane.depth_at(corner);
    // Depths count from the first corner's: from the farthest one that is rounded least.
    std::rotate(window.begin(), std::ranges::min_element(window, {}, &WindowVertex::depth), window.end());
  }
  if (!set_up(window, terms.limits, triangle, drawn.layer > 0)) return;
  triangle.slot = drawn.slot;
  if (drawn.cut != 0) {
    triangle.sides = &terms.sides;
    triangle.cut = drawn.cut;
  }
  if (drawn.layer > 1) put_below(drawn.layer - 1, terms.layers, triangle);
  hold_to(limit, std::min({slack(limit, window[0]), slack(limit, window[1]), slack(limit, window[2])}),
          triangle);
  add(terms, triangle, drawn.texture, result);
}

void add_clipped(const GeometryTerms& terms, const std::array<ClipCorner, 3>& corners, const Drawn& drawn,
                 const DepthLimit& limit, StretchTriangles& result) {
  const ClippedPolygon polygon = clip_triangle(corners, terms.window);
  for (size_t i = 2; i < polygon.count; ++i) {
    const std::array<WindowVertex, 3> window = {polygon.corners[0], polygon.corners[i - 1],
                                                polygon.corners[i]};
    add_window(terms, window, drawn, limit, result);
  }
}

}  // namespace

VertexStage::VertexStage(const FrameView& view)
    : clip(clip_terms(view)), orthographic(view.clip.orthographic) {}

GeometryTerms::GeometryTerms(const FrameView& view, const BoxProjector& of_view, const SamplePlace& place)
    : VertexStage(view),
      projector(&of_view),
      layers(view),
      sample(place),
      window(view.view().width, view.view().height, place),
      limits{view.view().width, view.view().height},
      sides(sides_over(PixelSides(view, place))) {}

template <typename Position>
Position VertexStage::to_clip(const PlacedLattice& placed, const RasterChunk& chunk, size_t vertex) const {
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

template glm::dvec4 VertexStage::to_clip(const PlacedLattice&, const RasterChunk&, size_t) const;

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

LayerTerms GeometryTerms::layer_terms() const {
  return {layers.focal_x, layers.focal_y, layers.axis_x,   layers.axis_y,
          layers.step,    layers.snapped, layers.parallel, LayerOffset::depth_rounding};
}

namespace {

void transform_vertices(const GeometryTerms& terms, const PlacedLattice& placed, const RasterChunk& chunk,
                        const RasterChunk::VertexRange& range, Stage& stage) {
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    const size_t first = range.first;
    kernels->transform_vertices(terms.transform_terms(placed),
                                {chunk.x.data() + first, chunk.y.data() + first, chunk.z.data() + first},
                                static_cast<int32_t>(range.last - range.first + 1), stage.from(first));
    return;
  }
  for (size_t i = range.first; i <= range.last; ++i) {
    const auto position = terms.to_clip<glm::vec4>(placed, chunk, i);
    if (!terms.window.is_inside(position)) {
      stage.x[i] = outside_x;
      continue;
    }
    const WindowVertex vertex = terms.window.apply(position);
    stage.x[i] = vertex.x;
    stage.y[i] = vertex.y;
    stage.depth[i] = vertex.depth;
  }
}

bool is_outside(const std::array<WindowVertex, 3>& corners) {
  return corners[0].x == outside_x || corners[1].x == outside_x || corners[2].x == outside_x;
}

/// Whether it is outward, and shows its back.
bool faces_away(const DrawnRange& range, uint32_t triangle, const std::array<WindowVertex, 3>& corners) {
  if (range.front == 0 || !range.chunk->is_outward(triangle)) return false;
  return range.front > 0 ? twice_area(corners) < 0 : twice_area(corners) > 0;
}

/// Triangles of a range that may cover a pixel, or have to be clipped: their numbers in `stage.candidates`.
size_t find_candidates(const GeometryTerms& terms, const DrawnRange& range, const DepthSource& drawn,
                       Stage& stage) {
  const RasterChunk& chunk = *range.chunk;
  const auto corners = [&](size_t k) { return chunk.corner[k].data() + range.first_triangle; };
  if (const RasterKernels* const kernels = raster_kernels(instruction_set())) {
    return static_cast<size_t>(kernels->find_candidates(
        stage.from(0), {corners(0), corners(1), corners(2)}, static_cast<int32_t>(range.triangle_count),
        {chunk.outward.data(), range.first_triangle, range.front}, drawn, stage.candidates.data()));
  }
  size_t found = 0;
  for (uint32_t i = 0; i < range.triangle_count; ++i) {
    const std::array<WindowVertex, 3> window = {stage[corners(0)[i]], stage[corners(1)[i]],
                                                stage[corners(2)[i]]};
    if (is_outside(window) ||
        (!pixel_box(window, terms.limits).empty() && !faces_away(range, range.first_triangle + i, window)))
      stage.candidates[found++] = i;
  }
  return found;
}

/// Has the kernels make what they can of the candidates; how many are left of them.
size_t make_with_kernels(const GeometryTerms& terms, const DrawnRange& range, Stage& stage, size_t found,
                         StretchTriangles& result) {
  const RasterKernels* const kernels = raster_kernels(instruction_set());
  if (kernels == nullptr || range.cut != 0 || range.transparent || range.cut_out || found == 0) return found;
  const RasterChunk& chunk = *range.chunk;
  const auto corners = [&](size_t k) { return chunk.corner[k].data() + range.first_triangle; };
  const TransformTerms transform = terms.transform_terms(range.placed);
  const SetUpTerms set_up{
      .points = stage.from(0),
      .lattice = {chunk.x.data(), chunk.y.data(), chunk.z.data()},
      .transform = &transform,
      .layer_offset = terms.layer_terms(),
      .corners = {corners(0), corners(1), corners(2)},
      .pieces = chunk.piece.data(),
      .limits = result.limits.data(),
      .layers = chunk.layers.empty() ? nullptr : chunk.layers.data() + range.first_triangle,
      .first_slot = range.first_slot,
      .width = terms.limits.width,
      .height = terms.limits.height};
  SetUpResult made = result.kernel.begin(found);
  made.rest = stage.candidates.data();
  kernels->set_up(set_up, stage.candidates.data(), static_cast<int32_t>(found), made);
  result.kernel.keep(made);
  if (made.lowest_row <= made.highest_row) add_rows(made.lowest_row, made.highest_row, result);
  return static_cast<size_t>(made.rest_count);
}

}  // namespace

[[gnu::noinline]] void make_triangles(const GeometryTerms& terms, const DrawnRange& range,
                                      std::span<const LatticeBox> pieces, const DepthSource& drawn,
                                      StretchTriangles& result) {
  result.kernel.clear();
  result.small.clear();
  result.large.clear();
  result.cut_out.clear();
  result.limits.clear();
  result.bottom = 0;
  result.top = -1;
  if (range.triangle_count == 0) return;
  for (const LatticeBox& piece : pieces)
    result.limits.push_back(depth_limit(terms.projector->pixel_bound(piece), terms.sample));
  const RasterChunk& chunk = *range.chunk;
  static thread_local Stage stage;
  stage.make_room(chunk.vertex_count(), range.triangle_count);
  transform_vertices(terms, range.placed, chunk, chunk.vertices(range.first_triangle, range.triangle_count),
                     stage);
  size_t found = find_candidates(terms, range, drawn, stage);
  found = make_with_kernels(terms, range, stage, found, result);
  for (size_t candidate = 0; candidate < found; ++candidate) {
    const uint32_t i = stage.candidates[candidate], triangle = range.first_triangle + i;
    const std::array<uint32_t, 3> corners = {chunk.corner[0][triangle], chunk.corner[1][triangle],
                                             chunk.corner[2][triangle]};
    const DepthLimit& limit = result.limits[chunk.piece[corners[0]]];
    Drawn own{range.first_slot + i, chunk.layer(triangle), range.cut};
    SurfaceTexture texture;
    if (range.cut_out) {
      texture = surface_texture(terms, terms.limits.width, terms.limits.height, range.placed, chunk, triangle,
                                terms.materials[chunk.color[triangle]]);
      own.texture = &texture;
    }
    if (own.layer > 0) {
      const auto exact = [&](size_t k) { return terms.to_clip<glm::dvec4>(range.placed, chunk, corners[k]); };
      own.plane = ExactPlane({exact(0), exact(1), exact(2)}, terms.window);
    }
    const std::array<WindowVertex, 3> window = {stage[corners[0]], stage[corners[1]], stage[corners[2]]};
    if (!is_outside(window)) {
      add_window(terms, window, own, limit, result);
      continue;
    }
    std::array<ClipCorner, 3> positions;
    for (size_t k = 0; k < 3; ++k) {
      positions[k] = {terms.to_clip<glm::vec4>(range.placed, chunk, corners[k]),
                      terms.to_clip<glm::dvec4>(range.placed, chunk, corners[k])};
    }
    add_clipped(terms, positions, own, limit, result);
  }
}

}  // namespace triptych
