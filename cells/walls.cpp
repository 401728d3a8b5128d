#include "cells/walls.hpp"

#include "base/threads.hpp"
#include "scene/moving_parts.hpp"
#include "scene/transparency.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace triptych {

namespace {

// What is smaller against the square of the model's diagonal: triangles, and faces of chunks' boxes.
constexpr double least_triangle = 1e-6, least_chunk = 1e-5;

struct FoundWall {
  int axis = 0;
  double at = 0;
  WallTriangle triangle;
};

double area_of(const WallTriangle& triangle) {
  const glm::dvec2 a = triangle.corners[1] - triangle.corners[0],
                   b = triangle.corners[2] - triangle.corners[0];
  return (a.x * b.y - a.y * b.x) / 2;
}

/// Where a chunk of full detail lies.
struct PlacedChunk {
  uint32_t chunk = 0, transform = 0;
};

double largest_face(const Box& box) {
  const glm::dvec3 size = box.hi - box.lo;
  return std::max({size.x * size.y, size.y * size.z, size.z * size.x});
}

class WallFinder {
 public:
  explicit WallFinder(const Pack& pack) : pack_(pack), skeleton_(pack.skeleton()), palette_(skeleton_) {
    const double diagonal = skeleton_.diagonal();
    walls_.tolerance = 4 * skeleton_.lattice().step + 1e-7 * diagonal;
    least_area_ = least_triangle * diagonal * diagonal;
    least_face_ = least_chunk * diagonal * diagonal;
  }

  Walls run() {
    const std::vector<PlacedChunk> placed = placed_chunks();
    std::vector<size_t> firsts;
    for (size_t i = 0; i < placed.size(); ++i) {
      if (i == 0 || placed[i].chunk != placed[i - 1].chunk) firsts.push_back(i);
    }
    std::vector<std::vector<FoundWall>> found(firsts.size());
    parallel_for(firsts.size(), [&](size_t group) {
      const size_t end = group + 1 < firsts.size() ? firsts[group + 1] : placed.size();
      look_at(std::span(placed).subspan(firsts[group], end - firsts[group]), found[group]);
    });
    std::vector<FoundWall> all;
    for (const std::vector<FoundWall>& of_chunk : found)
      all.insert(all.end(), of_chunk.begin(), of_chunk.end());
    gather(all);
    return std::move(walls_);
  }

 private:
  /// By chunk.
  std::vector<PlacedChunk> placed_chunks() const {
    std::vector<PlacedChunk> placed;
    for (SceneNodeId id = 0; id < skeleton_.scene_nodes.size(); ++id) {
      const SceneNode& node = skeleton_.scene_nodes[id];
      if (node.child_count > 0 || node.drawable_count == 0) continue;
      if (skeleton_.moving && skeleton_.moving->node_of[id] != no_id) continue;
      if (largest_face(skeleton_.lattice().box(node.box)) < least_face_) continue;
      const Drawable& drawable = skeleton_.drawables[node.first_drawable];
      for (uint32_t i = 0; i < drawable.placement_count; ++i) {
        const Placement& placement = skeleton_.placements[drawable.first_placement + i];
        placed.push_back({placement.chunk, placement.transform});
      }
    }
    std::sort(placed.begin(), placed.end(), [](const PlacedChunk& a, const PlacedChunk& b) {
      return a.chunk != b.chunk ? a.chunk < b.chunk : a.transform < b.transform;
    });
    return placed;
  }

  /// One chunk in all its places.
  void look_at(std::span<const PlacedChunk> placed, std::vector<FoundWall>& found) const {
    const ChunkInfo& info = skeleton_.chunks[placed.front().chunk];
    const Lattice& lattice = skeleton_.lattices[info.lattice];
    std::vector<uint32_t> large;
    for (uint32_t i = 0; i < placed.size(); ++i) {
      const Box box = placed_box(skeleton_.transforms[placed[i].transform], lattice.box(info.box));
      if (largest_face(box) >= least_face_) large.push_back(i);
    }
    if (large.empty()) return;
    const Chunk chunk = pack_.read_chunk(placed.front().chunk);
    for (const uint32_t i : large) {
      const Affine& transform = skeleton_.transforms[placed[i].transform];
      for (size_t triangle = 0; triangle < chunk.triangle_count(); ++triangle) {
        if (is_seen_through(palette_, palette_index(chunk, triangle))) continue;
        std::array<glm::dvec3, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
          const glm::ivec3& point = chunk.vertices[chunk.indices[3 * triangle + k]].point;
          corners[k] = transform * glm::dvec4(lattice.position(point), 1);
        }
        look_at(corners, found);
      }
    }
  }

  void look_at(const std::array<glm::dvec3, 3>& corners, std::vector<FoundWall>& found) const {
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = std::min({corners[0][axis], corners[1][axis], corners[2][axis]});
      const double hi = std::max({corners[0][axis], corners[1][axis], corners[2][axis]});
      if (hi - lo > walls_.tolerance) continue;
      FoundWall wall{axis, (lo + hi) / 2, {}};
      for (size_t k = 0; k < 3; ++k)
        wall.triangle.corners[k] = {corners[k][first_axis(axis)], corners[k][second_axis(axis)]};
      double area = area_of(wall.triangle);
      if (area < 0) std::swap(wall.triangle.corners[1], wall.triangle.corners[2]);
      if (std::abs(area) >= least_area_) found.push_back(wall);
      return;
    }
  }

  /// Into planes: those that are as far apart as the tolerance, or less, are one.
  void gather(std::vector<FoundWall>& all) {
    std::stable_sort(all.begin(), all.end(), [](const FoundWall& a, const FoundWall& b) {
      return a.axis != b.axis ? a.axis < b.axis : a.at < b.at;
    });
    walls_.triangles = all.size();
    for (const FoundWall& wall : all) {
      if (walls_.planes.empty() || walls_.planes.back().axis != wall.axis ||
          wall.at - walls_.planes.back().at > walls_.tolerance)
        walls_.planes.push_back({wall.axis, wall.at, {}, 0});
      walls_.planes.back().triangles.push_back(wall.triangle);
      walls_.planes.back().area += area_of(wall.triangle);
    }
  }

  const Pack& pack_;
  const Skeleton& skeleton_;
  Palette palette_;
  Walls walls_;
  double least_area_ = 0, least_face_ = 0;
};

}  // namespace

Walls find_walls(const Pack& pack) { return WallFinder(pack).run(); }

}  // namespace triptych
