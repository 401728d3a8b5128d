#include "preprocess/covered/leave_out.hpp"

#include "preprocess/covered/error_gaps.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// How many of the triangles are left out, and whether that is some of them.
bool leaves_out_some(const Surface& surface, double distance) {
  const auto count = std::ranges::count_if(
      surface.triangles, [&](const Triangle& triangle) { return is_left_out(triangle, distance); });
  return count > 0 && static_cast<size_t>(count) < surface.triangles.size();
}

}  // namespace

bool is_left_out(const Triangle& triangle, double distance) {
  const uint32_t of_class = covered_class(triangle.material);
  return of_class > 0 && distance_of_class(of_class) <= distance;
}

std::optional<Piece> without_covered(const Piece& piece, double distance) {
  if (!leaves_out_some(piece.surface, distance)) return std::nullopt;
  std::vector<Triangle> triangles;
  std::vector<SurfaceCorners> colors;
  for (size_t i = 0; i < piece.surface.triangles.size(); ++i) {
    if (is_left_out(piece.surface.triangles[i], distance)) continue;
    triangles.push_back(piece.surface.triangles[i]);
    if (!piece.surface.colors.empty()) colors.push_back(piece.surface.colors[i]);
  }
  Piece left = extract(piece.surface.points, triangles, colors);
  for (uint32_t& source : left.sources) source = piece.sources[source];
  return left;
}

double leave_out_covered(Baked& baked, double distance) {
  if (!leaves_out_some(baked.surface, distance)) return 0;
  double furthest = 0;
  for (const Triangle& triangle : baked.surface.triangles) {
    if (is_left_out(triangle, distance))
      furthest = std::max(furthest, distance_of_class(covered_class(triangle.material)));
  }
  baked.seen_from_outside = true;
  Piece all{std::move(baked.surface), {}};
  for (uint32_t i = 0; i < all.surface.points.size(); ++i) all.sources.push_back(i);
  std::vector<SourceObjectId> objects;
  for (size_t i = 0; i < baked.objects.size(); ++i) {
    if (!is_left_out(all.surface.triangles[i], distance)) objects.push_back(baked.objects[i]);
  }
  Piece left = *without_covered(all, distance);
  std::vector<LeafSpan> spans;
  for (const uint32_t source : left.sources) spans.push_back(baked.spans[source]);
  baked.surface = std::move(left.surface);
  baked.spans = std::move(spans);
  baked.objects = std::move(objects);
  return furthest;
}

Surface speck(const Surface& surface) {
  const Triangle& first = surface.triangles.front();
  const glm::ivec3 at = surface.points[first.vertices[0]];
  // Along two axes in which it extends, so that it stays in the surface's box.
  const LatticeBox box = surface.box();
  Surface speck{.points = {at}, .triangles = {{{0, 1, 2}, first.material}}};
  for (int axis = 0; axis < 3 && speck.points.size() < 3; ++axis) {
    if (box.lo[axis] == box.hi[axis]) continue;
    speck.points.push_back(at);
    speck.points.back()[axis] += at[axis] < box.hi[axis] ? 1 : -1;
  }
  if (!surface.colors.empty()) speck.colors = {surface.colors.front()};
  return speck;
}

}  // namespace triptych
