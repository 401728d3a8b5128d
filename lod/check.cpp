#include "lod/check.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "lod/check_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

/// Points that one drawable gets at least and at most, both directions together.
constexpr uint64_t fewest_points = 2'000, most_points = 100'000;

class Checking {
 public:
  Checking(const Pack& pack, const CheckOptions& options)
      : pack_(pack), skeleton_(pack.skeleton()), options_(options) {}

  CheckReport run() {
    check_nested_boxes();
    check_errors();
    check_chunks();
    check_distances();
    return std::move(report_);
  }

 private:
  template <typename... Arguments>
  void violation(uint64_t& count, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    ++count;
    if (report_.messages.size() < options_.messages) {
      report_.messages.push_back(pack_.name() + ": " +
                                 fmt::format(format, std::forward<Arguments>(arguments)...));
    }
  }

  void check_nested_boxes() {
    for (size_t i = 1; i < skeleton_.scene_nodes.size(); ++i) {
      const SceneNode& node = skeleton_.scene_nodes[i];
      if (skeleton_.scene_nodes[node.parent].box.contains(node.box)) continue;
      violation(report_.box_violations, "scene node {}: its box leaves that of its parent {}", i,
                node.parent);
    }
  }

  /// Errors must not shrink from a drawable to the next coarser one, nor from a scene node's coarsest to its
  /// parent's finest.
  void check_errors() {
    const auto& nodes = skeleton_.scene_nodes;
    std::vector<double> below(nodes.size(), 0);  // the largest error that any child ends with
    for (size_t i = nodes.size(); i-- > 0;) {
      double last = below[i];
      for (uint32_t k = 0; k < nodes[i].drawable_count; ++k) {
        const DrawableId id = nodes[i].first_drawable + k;
        const double error = skeleton_.drawables[id].error;
        if (error < last) {
          violation(report_.monotonicity_violations,
                    "drawable {}: error {} is less than {}, that of a finer one", id, error, last);
        }
        last = std::max(last, error);
      }
      if (i > 0) below[nodes[i].parent] = std::max(below[nodes[i].parent], last);
    }
  }

  /// Reads every chunk once and follows it through all its placements.
  void check_chunks() {
    std::vector<std::vector<std::pair<DrawableId, uint32_t>>> users(
        skeleton_.chunks.size());  // drawable, transform
    for (DrawableId id = 0; id < skeleton_.drawables.size(); ++id) {
      const Drawable& drawable = skeleton_.drawables[id];
      for (uint32_t i = 0; i < drawable.placement_count; ++i) {
        const Placement& placement = skeleton_.placements[drawable.first_placement + i];
        users[placement.chunk].emplace_back(id, placement.transform);
      }
    }
    std::vector<std::string> damage(users.size());
    std::vector<std::vector<DrawableId>> outside(users.size());
    Progress progress("check: chunks", users.size());
    parallel_for(users.size(), [&](size_t i) {
      try {
        const Chunk chunk = pack_.read_chunk(static_cast<uint32_t>(i));
        for (const auto& [id, transform] : users[i]) {
          if (leaves_box(chunk, skeleton_.lattices[skeleton_.chunks[i].lattice], id, transform))
            outside[i].push_back(id);
        }
      } catch (const Error& error) {
        damage[i] = error.what();
      }
      progress.advance();
    });
    for (size_t i = 0; i < users.size(); ++i) {
      if (!damage[i].empty()) {
        ++report_.checksum_errors;
        if (report_.messages.size() < options_.messages) report_.messages.push_back(damage[i]);
      }
      for (const DrawableId id : outside[i]) {
        violation(report_.box_violations, "drawable {}: chunk {} leaves the box of scene node {}", id, i,
                  skeleton_.drawables[id].scene_node);
      }
    }
  }

  bool leaves_box(const Chunk& chunk, const Lattice& lattice, DrawableId id, uint32_t transform_index) const {
    const Box box = skeleton_.lattice().box(skeleton_.scene_nodes[skeleton_.drawables[id].scene_node].box);
    const Affine& transform = skeleton_.transforms[transform_index];
    return std::any_of(chunk.vertices.begin(), chunk.vertices.end(), [&](const ChunkVertex& vertex) {
      const glm::dvec3 position = transform * glm::dvec4(lattice.position(vertex.point), 1);
      return !box.contains(Box{position, position});
    });
  }

  void check_distances();

  const Pack& pack_;
  const Skeleton& skeleton_;
  const CheckOptions& options_;
  CheckReport report_;
};

/// A number that looks random and is the same on every machine (splitmix64, Sebastiano Vigna), from 0 up
/// to 1.
double scattered(uint64_t value) {
  value += 0x9e3779b97f4a7c15u;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((value ^ (value >> 31)) >> 11) * 0x1p-53;
}

/// Index i of `count` that are spread evenly over `total`.
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

/// The largest distance found between the drawable and its source, both ways.
double measured_distance(const PackSurfaces& surfaces, DrawableId id, uint64_t points) {
  const Drawable& drawable = surfaces.skeleton().drawables[id];
  std::vector<uint32_t> own(drawable.placement_count);
  for (uint32_t i = 0; i < drawable.placement_count; ++i) own[i] = drawable.first_placement + i;
  double largest = 0;
  for_each_point(surfaces, own, points / 2, [&](const glm::dvec3& point) {
    largest = std::max(largest, surfaces.distance_to_source(drawable.scene_node, point, largest));
  });
  for_each_point(surfaces, surfaces.source_placements(drawable.scene_node), points / 2,
                 [&](const glm::dvec3& point) {
                   largest = std::max(largest, surfaces.distance_to_drawable(id, point, largest));
                 });
  return largest;
}

void Checking::check_distances() {
  const PackSurfaces surfaces(pack_);
  const auto& drawables = skeleton_.drawables;
  std::vector<double> measured(drawables.size(), std::numeric_limits<double>::quiet_NaN());
  const uint64_t points =
      std::clamp(options_.points / std::max<uint64_t>(drawables.size(), 1), fewest_points, most_points);
  const auto is_source = [&](DrawableId id) {
    const SceneNode& node = skeleton_.scene_nodes[drawables[id].scene_node];
    return node.child_count == 0 && node.first_drawable == id;
  };
  {
    Progress progress("check: distances", drawables.size());
    parallel_for(drawables.size(), [&](size_t i) {
      const auto id = static_cast<DrawableId>(drawables.size() - 1 - i);  // siblings together, leaves first
      try {
        measured[id] = is_source(id) ? 0 : measured_distance(surfaces, id, points);
      } catch (const Error&) {  // a damaged chunk, which was counted before
      }
      progress.advance();
    });
  }
  const Box model = skeleton_.lattice().box(skeleton_.scene_nodes[0].box);
  const glm::dvec3 furthest = glm::max(glm::abs(model.lo), glm::abs(model.hi));
  const double tolerance =
      64 * std::numeric_limits<double>::epsilon() * std::max({furthest.x, furthest.y, furthest.z});
  std::vector<double> ratios;
  for (DrawableId id = 0; id < drawables.size(); ++id) {
    const double error = drawables[id].error;
    if (std::isnan(measured[id])) {
      ++report_.drawables_not_checked;
      continue;
    }
    ++report_.drawables_checked;
    if (measured[id] > error * (1 + 1e-6) + tolerance) {
      violation(report_.bound_violations,
                "drawable {} of scene node {}: is {} from its source, and promises {}", id,
                drawables[id].scene_node, measured[id], error);
    }
    if (!is_source(id) && measured[id] > skeleton_.lattice().rounding())
      ratios.push_back(error / measured[id]);
  }
  report_.bound_over_measured = distribution(ratios);
}

}  // namespace

CheckReport check_pack(const Pack& pack, const CheckOptions& options) {
  return Checking(pack, options).run();
}

}  // namespace triptych
