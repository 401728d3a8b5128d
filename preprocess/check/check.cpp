#include "preprocess/check/check.hpp"

#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/rounding.hpp"
#include "base/threads.hpp"
#include "preprocess/check/check_distances.hpp"
#include "preprocess/check/said_closed.hpp"
#include "preprocess/outward.hpp"
#include "scene/pack_objects.hpp"
#include "scene/poses.hpp"
#include "scene/seen_from_outside.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/core.h>
#include <glm/vec4.hpp>
#include <mutex>

namespace triptych {

namespace {

class Checking {
 public:
  Checking(const Pack& pack, const CheckOptions& options)
      : pack_(pack), skeleton_(pack.skeleton()), options_(options), poses_(poses_to_check(pack.skeleton())) {}

  CheckReport run() {
    check_nested_boxes();
    check_errors();
    check_chunks();
    check_sections();
    check_distances();
    return std::move(report_);
  }

 private:
  template <typename... Arguments>
  void violation(uint64_t& count, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    ++count;
    if (report_.messages.size() >= options_.messages) return;
    report_.messages.push_back(pack_.name() + ": " +
                               fmt::format(format, std::forward<Arguments>(arguments)...));
    found(report_.messages.back());
  }

  /// Tells what was found, unless enough was told. Threads may call it.
  void found(const std::string& message) {
    const std::lock_guard lock(telling_);
    if (options_.found && told_++ < options_.messages) options_.found(message);
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
    std::vector<double> below(nodes.size(), 0);  // the largest error of a child's coarsest drawable
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

  /// Reads every chunk once and checks it in all its placements.
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
    std::vector<uint8_t> turned(users.size());
    SaidClosed said(skeleton_);
    Progress progress("check: chunks", users.size());
    parallel_for(users.size(), [&](size_t i) {
      try {
        const Chunk chunk = pack_.read_chunk(static_cast<uint32_t>(i));
        turned[i] = !is_outward_as_said(chunk, skeleton_);
        said.add(static_cast<uint32_t>(i), chunk);
        for (const auto& [id, transform] : users[i]) {
          if (leaves_box(chunk, skeleton_.lattices[skeleton_.chunks[i].lattice], id, transform))
            outside[i].push_back(id);
        }
      } catch (const Error& error) {
        damage[i] = error.what();
        found(damage[i]);
      }
      progress.advance();
    });
    if (std::ranges::all_of(damage, &std::string::empty)) check_closed(said);
    for (size_t i = 0; i < users.size(); ++i) {
      if (!damage[i].empty()) {
        ++report_.checksum_errors;
        if (report_.messages.size() < options_.messages) report_.messages.push_back(damage[i]);
      }
      if (turned[i] != 0) {
        violation(report_.outward_violations,
                  "chunk {}: triangles are not proven to be outward, and are said to be", i);
      }
      for (const DrawableId id : outside[i]) {
        violation(report_.box_violations, "drawable {}: chunk {} leaves the box of scene node {}", id, i,
                  skeleton_.drawables[id].scene_node);
      }
    }
  }

  void check_closed(const SaidClosed& said) {
    for (const uint32_t chunk : said.open_chunks()) {
      violation(report_.outward_violations,
                "chunk {}: its first {} triangles are not closed, and are said to be", chunk,
                skeleton_.closed.in_chunk(chunk));
    }
    for (const uint32_t body : said.open_bodies())
      violation(report_.outward_violations, "body {} is not closed within its box, and is said to be", body);
  }

  /// Those that opening the pack did not read.
  void check_sections() {
    const auto check = [&](const auto& read) {
      try {
        read();
      } catch (const Error& error) {
        ++report_.checksum_errors;
        if (report_.messages.size() < options_.messages) report_.messages.push_back(error.what());
        found(error.what());
      }
    };
    check([&] { pack_.read_objects(); });
    check([&] { pack_.read_options(); });
    for (uint32_t texture = 0; texture < skeleton_.textures.size(); ++texture) {
      for (uint32_t level = 0; level < skeleton_.textures[texture].levels.size(); ++level)
        check([&] { pack_.read_texels(texture, level); });
    }
  }

  static bool is_outward_as_said(const Chunk& chunk, Palette palette) {
    if (chunk.outward_runs.empty()) return true;
    std::vector<glm::ivec3> points;
    for (const ChunkVertex& vertex : chunk.vertices) points.push_back(vertex.point);
    std::vector<bool> seen_through;
    for (size_t i = 0; i < chunk.triangle_count(); ++i)
      seen_through.push_back(is_seen_through(palette, palette_index(chunk, i)));
    const std::vector<bool> claimed = chunk.outward(),
                            proven = outward_triangles(points, chunk.indices, seen_through);
    return std::equal(claimed.begin(), claimed.end(), proven.begin(), proven.end(),
                      [](bool said, bool is) { return is || !said; });
  }

  bool leaves_box(const Chunk& chunk, const Lattice& lattice, DrawableId id, uint32_t transform_index) const {
    const SceneNodeId node = skeleton_.drawables[id].scene_node;
    const LatticeBox& box = skeleton_.scene_nodes[node].box;
    const Affine& transform = skeleton_.transforms[transform_index];
    if (leaves_box(chunk, lattice, box, transform)) return true;
    // What moves is in the box that it has at a time, which is within that of all times.
    return std::any_of(poses_.begin(), poses_.end(), [&](const auto& poses) {
      return poses->moves(node) && poses->is_there(node) &&
             leaves_box(chunk, lattice, poses->box(skeleton_.lattice(), node, box),
                        poses->transform(transform_index, transform));
    });
  }

  /// Many that no clip's length is a multiple of.
  static std::vector<std::shared_ptr<const Poses>> poses_to_check(const Skeleton& skeleton) {
    std::vector<std::shared_ptr<const Poses>> poses;
    if (!skeleton.moving) return poses;
    constexpr size_t times = 48;
    const double step = longest_clip(skeleton.moving->motion) / (times - 0.382);
    for (size_t i = 0; i < times; ++i)
      poses.push_back(skeleton.moving->poses_at(step * static_cast<double>(i)));
    return poses;
  }

  bool leaves_box(const Chunk& chunk, const Lattice& lattice, const LatticeBox& on_lattice,
                  const Affine& transform) const {
    const Box box = skeleton_.lattice().box(on_lattice);
    return std::any_of(chunk.vertices.begin(), chunk.vertices.end(), [&](const ChunkVertex& vertex) {
      const glm::dvec3 position = transform * glm::dvec4(lattice.position(vertex.point), 1);
      return !box.contains(Box{position, position});
    });
  }

  void check_distances();
  void check_left_out(DrawableId id, const MeasuredDrawable& measured);

  const Pack& pack_;
  const Skeleton& skeleton_;
  const CheckOptions& options_;
  const std::vector<std::shared_ptr<const Poses>> poses_;  ///< at some times; none where nothing moves
  CheckReport report_;
  std::mutex telling_;
  size_t told_ = 0;
};

void Checking::check_distances() {
  const auto& drawables = skeleton_.drawables;
  const std::vector<MeasuredDrawable> measured = measured_drawables(pack_, options_.points);
  const double rounding = distance_rounding(skeleton_);
  std::vector<double> ratios;
  for (DrawableId id = 0; id < drawables.size(); ++id) {
    const double error = drawables[id].error, distance = measured[id].distance;
    if (std::isnan(distance)) {
      ++report_.drawables_not_checked;
      continue;
    }
    ++report_.drawables_checked;
    check_left_out(id, measured[id]);
    if (distance > error * (1 + 1e-6) + rounding) {
      violation(report_.bound_violations,
                "drawable {} of scene node {}: is {} from its source, and promises {}", id,
                drawables[id].scene_node, distance, error);
    }
    if (!is_source(skeleton_, id) && distance > skeleton_.lattice().rounding())
      ratios.push_back(error / distance);
  }
  report_.bound_over_measured = distribution(ratios);
}

/// What others cover may be left out of what is marked, and only what lies right beneath them.
void Checking::check_left_out(DrawableId id, const MeasuredDrawable& measured) {
  const Drawable& drawable = skeleton_.drawables[id];
  const auto report = [&](const glm::dvec3& place, const std::string& what) {
    violation(report_.seen_violations, "drawable {} of scene node {}: leaves out what is at {}, {}, {}, {}",
              id, drawable.scene_node, place.x, place.y, place.z, what);
  };
  if (measured.left_out && !is_seen_from_outside(skeleton_, drawable)) {
    report(*measured.left_out, "and is not marked in section SEEN: it is drawn where that may show");
  } else if (measured.uncovered) {
    report(*measured.uncovered, fmt::format("and nothing else is there to within its error of {}: what hides "
                                            "that place may be hidden or cut away, and the level drawn",
                                            drawable.error));
  }
}

}  // namespace

CheckReport check_pack(const Pack& pack, const CheckOptions& options) {
  return round_to_nearest([&] { return Checking(pack, options).run(); });
}

}  // namespace triptych
