// The order in which drawables are tested and drawn: roughly front to back, and the same on every machine.
#pragma once

#include "scene/camera.hpp"
#include "scene/skeleton.hpp"

#include <compare>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace triptych {

struct FrameView;

/// Squared distance from the eye's lattice cell to the scene node's box, in integers, ties by id. A child
/// never ranks before its parent.
struct DrawRank {
  uint64_t distance = 0;
  DrawableId id = 0;
  auto operator<=>(const DrawRank&) const = default;
};

/// Above every draw rank.
inline constexpr DrawRank everything_decided{std::numeric_limits<uint64_t>::max(), no_id};

/// The eye's cell on the model lattice, clamped to where differences still fit.
glm::ivec3 eye_cell(const Skeleton& skeleton, const View& view);
/// Squared distance from the cell to the box, in lattice steps; 0 inside it.
uint64_t squared_distance(const glm::ivec3& cell, const LatticeBox& box);
/// Of a model where nothing moves.
DrawRank draw_rank(const Skeleton& skeleton, const glm::ivec3& cell, DrawableId drawable);
/// In a view: of the box that the scene node has in its frame.
DrawRank draw_rank(const FrameView& view, DrawableId drawable);

/// Sorts drawables of one view by their draw rank; reuses its memory from one call to the next.
class RankSorter {
 public:
  void sort(const FrameView& view, std::vector<DrawableId>& drawables);

 private:
  std::vector<DrawRank> ranks_;
};

/// The same for a single call.
void sort_by_rank(const FrameView& view, std::vector<DrawableId>& drawables);
void sort_by_rank(const Skeleton& skeleton, const glm::ivec3& cell, std::vector<DrawableId>& drawables);

}  // namespace triptych
