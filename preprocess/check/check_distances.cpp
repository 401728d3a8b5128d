#include "preprocess/check/check_distances.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/check/check_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <numeric>

namespace triptych {

namespace {

/// The most points on a triangle besides its vertices.
constexpr uint64_t max_points_per_triangle = 4;

/// A number that looks random and is the same on every machine (splitmix64, Sebastiano Vigna), from 0 up
/// to 1.
double scattered(uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((value ^ (value >> 31)) >> 11) * 0x1p-53;
}

/// The i-th of `count` indices that are spread evenly over `total`.
uint64_t spread(uint64_t i, uint64_t count, uint64_t total) {
  return static_cast<uint64_t>(static_cast<double>(i) * static_cast<double>(total) /
                               static_cast<double>(count));
}

/// Calls `visit` with about `count` points of the placed chunks: half of them vertices (all, if there are no
/// more), half of them between, evenly over the triangles.
void for_each_point(const PackSurfaces& surfaces, const std::vector<uint32_t>& placements, uint64_t count,
                    const std::function<void(const glm::dvec3&)>& visit) {
  const Skeleton& skeleton = surfaces.skeleton();
  uint64_t vertex_total = 0, triangle_total = 0;
  for (const uint32_t placement : placements) {
    vertex_total += skeleton.chunks[skeleton.placements[placement].chunk].vertex_count;
    triangle_total += skeleton.chunks[skeleton.placements[placement].chunk].triangle_count;
  }
  const uint64_t vertex_count = std::min(vertex_total, count / 2),
                 between_count = std::min(count / 2, 64 * triangle_total);
  uint64_t vertex_start = 0, triangle_start = 0, next_vertex = 0, next_between = 0;
  for (const uint32_t index : placements) {
    const Placement& placement = skeleton.placements[index];
    const ChunkInfo& info = skeleton.chunks[placement.chunk];
    const uint64_t vertex_end = vertex_start + info.vertex_count,
                   triangle_end = triangle_start + info.triangle_count;
    const auto vertex_at = [&] { return spread(next_vertex, vertex_count, vertex_total); };
    const auto triangle_at = [&] { return spread(next_between, between_count, triangle_total); };
    const bool used = (next_vertex < vertex_count && vertex_at() < vertex_end) ||
                      (next_between < between_count && triangle_at() < triangle_end);
    if (used) {
      const auto tree = surfaces.tree(placement.chunk);
      const Affine& transform = surfaces.placing(placement.transform).transform;
      for (; next_vertex < vertex_count && vertex_at() < vertex_end; ++next_vertex) {
        visit(transform * glm::dvec4(tree->positions()[vertex_at() - vertex_start], 1));
      }
      for (; next_between < between_count && triangle_at() < triangle_end; ++next_between) {
        const uint32_t* corners = &tree->indices()[3 * (triangle_at() - triangle_start)];
        double u = scattered(2 * next_between), v = scattered(2 * next_between + 1);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const auto& positions = tree->positions();
        visit(transform * glm::dvec4(positions[corners[0]] * (1 - u - v) + positions[corners[1]] * u +
                                         positions[corners[2]] * v,
                                     1));
      }
    }
    vertex_start = vertex_end;
    triangle_start = triangle_end;
  }
}

/// Both ways, with what can be seen of the source.
MeasuredDrawable measure(const PackSurfaces& surfaces, DrawableId id, uint64_t points,
                         const std::function<void()>& between) {
  const Skeleton& skeleton = surfaces.skeleton();
  const Drawable& drawable = skeleton.drawables[id];
  std::vector<uint32_t> own(drawable.placement_count);
  for (uint32_t i = 0; i < drawable.placement_count; ++i) own[i] = drawable.first_placement + i;
  MeasuredDrawable measured;
  HeldTrees held;
  const double error = drawable.error * (1 + 1e-6) + distance_rounding(skeleton);
  // Lines in 26 directions come as near to what is `error` away as this.
  const double reach = 1.15 * drawable.error;
  uint64_t visited = 0;
  // Beyond rounding, of files, too, so that a point does not hide itself.
  const double start = std::max(1e-3 * drawable.error, 16 * skeleton.lattice().step);
  const auto pause = [&] {
    if (++visited % 1024 == 0) between();
  };
  for_each_point(surfaces, own, points / 2, [&](const glm::dvec3& point) {
    pause();
    measured.distance = std::max(
        measured.distance, surfaces.distance_to_source(drawable.scene_node, point, measured.distance, &held));
  });
  // Of what is left out it is enough to know one place of each kind.
  const auto is_left_out = [&](const glm::dvec3& point) {
    if (!surfaces.is_enclosed(drawable.scene_node, point, start, reach)) return false;
    measured.left_out = point;
    if (!measured.uncovered &&
        surfaces.nearest_source(0, point, error, &held, drawable.scene_node).distance > error)
      measured.uncovered = point;
    return true;
  };
  for_each_point(surfaces, surfaces.source_placements(drawable.scene_node), points / 2,
                 [&](const glm::dvec3& point) {
                   pause();
                   const double known = measured.distance,
                                distance = surfaces.distance_to_drawable(id, point, known, &held);
                   if (distance > std::max(known, error) && is_left_out(point)) return;
                   measured.distance = std::max(known, distance);
                 });
  return measured;
}

/// How many points a full measurement of each drawable takes: small ones need few.
std::vector<uint64_t> wanted_points(const Skeleton& skeleton, std::span<const DrawableId> drawables) {
  std::vector<uint64_t> source(skeleton.scene_nodes.size());  // triangles of the finest leaf drawables below
  for (size_t i = source.size(); i-- > 0;) {
    const SceneNode& node = skeleton.scene_nodes[i];
    if (node.child_count == 0) source[i] = skeleton.drawables[node.first_drawable].triangles;
    if (i > 0) source[node.parent] += source[i];
  }
  std::vector<uint64_t> wanted;
  for (const DrawableId id : drawables) {
    const Drawable& drawable = skeleton.drawables[id];
    const bool exact = is_source(skeleton, id);
    const uint64_t triangles = std::max<uint64_t>(source[drawable.scene_node], drawable.triangles);
    wanted.push_back(exact ? 0 : 4 * max_points_per_triangle * triangles);
  }
  return wanted;
}

/// The limit per drawable at which all wanted points, each clamped to it, stay within the budget.
uint64_t largest_share(std::vector<uint64_t> wanted, uint64_t budget) {
  std::sort(wanted.begin(), wanted.end());
  for (size_t i = 0; i < wanted.size(); ++i) {
    const uint64_t left = wanted.size() - i;
    if (wanted[i] > budget / left) return budget / left;
    budget -= wanted[i];
  }
  return wanted.empty() ? 0 : wanted.back();
}

/// To within the rounding of rotations.
bool nearly_equal(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0, difference = 0;
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      largest = std::max({largest, std::abs(a[column][row]), std::abs(b[column][row])});
      difference = std::max(difference, std::abs(a[column][row] - b[column][row]));
    }
  }
  return difference <= largest * 1e-12;
}

std::vector<MeasuredDrawable> measure_all(const Pack& pack, std::span<const DrawableId> drawables,
                                          uint64_t points, const std::function<void()>& between) {
  const Skeleton& skeleton = pack.skeleton();
  const PackSurfaces surfaces(pack);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<MeasuredDrawable> measured(drawables.size(), {unknown});
  const uint64_t share = largest_share(wanted_points(skeleton, drawables), points);
  Progress progress("check: distances", measured.size());
  parallel_for(measured.size(), [&](size_t i) {
    const size_t place = measured.size() - 1 - i;  // siblings together, leaves first
    const DrawableId id = drawables[place];
    between();
    try {
      measured[place] = is_source(skeleton, id) ? MeasuredDrawable() : measure(surfaces, id, share, between);
    } catch (const Error&) {  // a damaged chunk; the caller reads every chunk itself
      between();              // rethrows if the error came from `between`
    }
    progress.advance();
  });
  return measured;
}

}  // namespace

bool is_source(const Skeleton& skeleton, DrawableId id) {
  const SceneNode& node = skeleton.scene_nodes[skeleton.drawables[id].scene_node];
  return node.child_count == 0 && node.first_drawable == id;
}

std::vector<DrawableId> equally_distant(const Skeleton& skeleton) {
  std::vector<DrawableId> representatives(skeleton.drawables.size());
  std::iota(representatives.begin(), representatives.end(), 0u);
  struct Known {
    glm::dmat3 gram;  ///< products of the axes: what the transform does to lengths
    DrawableId first_drawable;
  };
  std::vector<std::vector<Known>> known(skeleton.sub_hierarchies);
  for (const ExpandedInstance& instance : skeleton.instances) {
    const glm::dmat3 axes(skeleton.transforms[instance.transform]);
    const glm::dmat3 gram = glm::transpose(axes) * axes;
    auto& others = known[instance.sub_hierarchy];
    const auto same = std::find_if(others.begin(), others.end(),
                                   [&](const Known& other) { return nearly_equal(other.gram, gram); });
    if (same == others.end()) {
      others.push_back({gram, instance.first_drawable});
      continue;
    }
    for (uint32_t i = 0; i < instance.drawable_count; ++i)
      representatives[instance.first_drawable + i] = same->first_drawable + i;
  }
  return representatives;
}

double distance_rounding(const Skeleton& skeleton) {
  const Box model = skeleton.lattice().box(skeleton.scene_nodes[0].box);
  const glm::dvec3 furthest = glm::max(glm::abs(model.lo), glm::abs(model.hi));
  return 64 * std::numeric_limits<double>::epsilon() * std::max({furthest.x, furthest.y, furthest.z});
}

std::vector<MeasuredDrawable> measured_drawables(const Pack& pack, uint64_t points) {
  const std::vector<DrawableId> representatives = equally_distant(pack.skeleton());
  std::vector<DrawableId> asked;
  for (DrawableId id = 0; id < representatives.size(); ++id) {
    if (representatives[id] == id) asked.push_back(id);
  }
  const std::vector<MeasuredDrawable> found = measure_all(pack, asked, points, [] {});
  std::vector<MeasuredDrawable> measured(representatives.size());
  for (size_t i = 0; i < asked.size(); ++i) measured[asked[i]] = found[i];
  for (DrawableId id = 0; id < representatives.size(); ++id) measured[id] = measured[representatives[id]];
  return measured;
}

std::vector<double> measured_distances(const Pack& pack, std::span<const DrawableId> drawables,
                                       uint64_t points, const std::function<void()>& between) {
  std::vector<double> distances;
  for (const MeasuredDrawable& measured : measure_all(pack, drawables, points, between))
    distances.push_back(measured.distance);
  return distances;
}

}  // namespace triptych
