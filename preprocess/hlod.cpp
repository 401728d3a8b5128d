#include "preprocess/hlod.hpp"

#include "preprocess/contacts/small_contacts.hpp"
#include "preprocess/covered/leave_out.hpp"
#include "preprocess/to_lattice.hpp"
#include "simplify/level_normals.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numeric>

namespace triptych {

uint32_t Baker::place(const glm::ivec3& point, const LeafSpan& span) {
  auto& points = baked_.surface.points;
  const auto [found, inserted] = points_.try_emplace(point, static_cast<uint32_t>(points.size()));
  if (inserted) {
    points.push_back(point);
    baked_.spans.push_back(span);
  } else {
    baked_.spans[found->second].extend(span);
  }
  return found->second;
}

/// Of triangles that are equal the first one stays, and says which object it is.
void Baker::add_triangle(const Triangle& triangle, const SurfaceCorners* colors, const CornerNormals& normals,
                         std::span<const SourceObjectId> objects, size_t index) {
  std::array<uint32_t, 3> turned = triangle.vertices;
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end()), turned.end());
  if (!triangles_.insert(turned).second) return;
  Surface& surface = baked_.surface;
  if (colors) surface.colors.resize(surface.triangles.size());  // those before have none
  const bool colored = colors || !surface.colors.empty();
  surface.triangles.push_back(triangle);
  if (colored) surface.colors.push_back(colors ? *colors : SurfaceCorners());
  if (has_normal(normals[0]) && surface.normals.empty()) surface.normals.resize(surface.triangles.size() - 1);
  if (has_normal(normals[0]) || !surface.normals.empty()) surface.normals.push_back(normals);
  if (!objects.empty()) baked_.objects.push_back(objects[index]);
}

void Baker::add(const Surface& surface, std::span<const LeafSpan> spans,
                std::span<const SourceObjectId> objects) {
  baked_.surface.file_normals = baked_.surface.file_normals || surface.file_normals;
  std::vector<uint32_t> placed;
  for (size_t i = 0; i < surface.points.size(); ++i) placed.push_back(place(surface.points[i], spans[i]));
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    Triangle triangle = surface.triangles[t];
    for (uint32_t& vertex : triangle.vertices) vertex = placed[vertex];
    add_triangle(triangle, surface.colors.empty() ? nullptr : &surface.colors[t],
                 surface.normals.empty() ? CornerNormals{} : surface.normals[t], objects, t);
  }
}

void Baker::add(const Surface& surface, const Lattice& from, const Affine& transform,
                std::span<const LeafSpan> spans, std::span<const SourceObjectId> objects) {
  moved_ = std::max(moved_, std::sqrt(3.0) / 2 * (1 + 1e-9));
  baked_.surface.file_normals = baked_.surface.file_normals || surface.file_normals;
  const glm::dmat3 of_normals = normal_matrix(glm::dmat3(transform));
  std::vector<glm::ivec3> points;
  for (const glm::ivec3& point : surface.points) {
    points.push_back(lattice_.nearest(transform * glm::dvec4(from.position(point), 1)));
  }
  const bool mirrors = rules_.mirrors_flip_winding && glm::determinant(glm::dmat3(transform)) < 0;
  for (size_t t = 0; t < surface.triangles.size(); ++t) {
    Triangle triangle = surface.triangles[t];
    SurfaceCorners colors = surface.colors.empty() ? SurfaceCorners() : surface.colors[t];
    CornerNormals normals{};
    if (!surface.normals.empty()) normals = placed_normals(surface.normals[t], of_normals);
    if (mirrors) {
      std::swap(triangle.vertices[1], triangle.vertices[2]);
      std::swap(colors[1], colors[2]);
      std::swap(normals[1], normals[2]);
    }
    std::array<glm::ivec3, 3> corners;
    for (size_t i = 0; i < 3; ++i) corners[i] = points[triangle.vertices[i]];
    if (degenerate(corners[0], corners[1], corners[2])) {
      corners = with_area(corners);
      moved_ = std::max(moved_, std::sqrt(3.0) / 2 + 1 + 1e-9);
    }
    for (size_t i = 0; i < 3; ++i) triangle.vertices[i] = place(corners[i], spans[triangle.vertices[i]]);
    add_triangle(triangle, surface.colors.empty() ? nullptr : &colors, normals, objects, t);
  }
}

/// Beside vertices that have colours of their own the others get their material's.
void Baker::fill_colors() {
  Surface& surface = baked_.surface;
  const auto has_own = [](const SurfaceCorners& corners) { return is_colored(corners[0].color); };
  if (std::ranges::none_of(surface.colors, has_own)) return;
  for (size_t i = 0; i < surface.colors.size(); ++i) {
    VertexColor color = palette_[palette_index(surface.triangles[i].material)];
    color[3] = 255;
    for (SurfaceCorner& corner : surface.colors[i]) {
      if (!is_colored(corner.color)) corner.color = color;
    }
  }
}

Baked Baker::finish(double error) {
  fill_colors();
  baked_.error = error + moved_ * lattice_.step;
  baked_.surface.drop_empty_normals();
  return std::move(baked_);
}

Hlod make_hlod(Baked children, uint32_t first_place, uint32_t end_place, const Lattice& lattice,
               const HlodLimits& limits) {
  std::vector<uint8_t> locked;
  for (const LeafSpan& span : children.spans)
    locked.push_back(span.first < first_place || span.last >= end_place);
  free_small_contacts(children, children.error / lattice.step, locked);
  Hlod hlod;
  SimplifyLimits how = limits.simplify;
  how.triangles = limits.triangles;
  how.colors = Colors::ignore;  // a level that merges a room's furniture cannot keep the colours apart
  Chain chain = simplify(children.surface, locked, how);
  if (limits.shade || children.surface.file_normals) {
    LevelNormals normals(children.surface,
                         children.error > 0 ? LevelNormals::Facets::coarse : LevelNormals::Facets::true_ones);
    const double before = children.error / lattice.step;
    for (Level& level : chain.levels) normals.shade(level.piece, before + level.bound);
  }
  hlod.stuck = chain.stuck && chain.levels.empty();
  if (chain.levels.empty() || limits.begins_as_it_is) {
    Level all{{children.surface, std::vector<uint32_t>(children.surface.points.size())}, 0, 0};
    std::iota(all.piece.sources.begin(), all.piece.sources.end(), 0u);
    chain.levels.insert(chain.levels.begin(), std::move(all));
  }
  bool& seen_from_outside = hlod.coarsest.seen_from_outside = children.seen_from_outside;
  for (Level& level : chain.levels) {
    const double error = beyond_gaps(children.error + level.bound * lattice.step, limits.gaps);
    if (auto left = without_covered(level.piece, error / lattice.step)) {
      level.piece = std::move(*left);
      seen_from_outside = true;
    }
    // Of levels with one error the coarsest is enough.
    if (!hlod.drawables.empty() && hlod.drawables.back().error >= error) hlod.drawables.pop_back();
    hlod.drawables.push_back({std::move(level.piece), error, seen_from_outside});
  }
  const HlodDrawable& last = hlod.drawables.back();
  for (const uint32_t source : last.piece.sources) hlod.coarsest.spans.push_back(children.spans[source]);
  hlod.coarsest.surface = last.piece.surface;
  hlod.coarsest.error = last.error;
  return hlod;
}

}  // namespace triptych
