// How much of the area that small objects cover is kept, averaged over shifts of the camera by parts of a
// pixel.
#pragma once

#include "measure/accuracy/surface_pixels.hpp"

#include <span>
#include <unordered_map>
#include <vector>

namespace triptych {

/// Pixels by the leaf that covers them, over several pictures.
using CoverCounts = std::unordered_map<SceneNodeId, uint64_t>;

struct CoverChange {
  double reference = 0;  ///< pixels of small objects in the reference
  double kept = 0;       ///< of those: how many each has at least
  double grown = 0;      ///< what objects have beyond theirs
};

/// `count` shifts spread over a pixel, in pixels: points of a (2, 3) Halton sequence.
std::vector<glm::dvec2> pixel_shifts(size_t count);
/// The same frame seen so many pixels aside: its frustum is moved.
FrameState shifted(FrameState state, const glm::dvec2& shift);

/// Leaves that show in the reference and whose boxes are at most this wide and high on the screen.
inline constexpr double small_object_pixels = 8;
std::vector<SceneNodeId> small_leaves(const Skeleton& skeleton, const FrameView& view,
                                      std::span<const uint32_t> reference_items);

/// Adds the pixels of these leaves (ascending) in a picture at full detail.
void count_cover(const Skeleton& skeleton, std::span<const uint32_t> reference_items,
                 std::span<const SceneNodeId> leaves, CoverCounts& counts);
/// Adds the pixels of these leaves in another picture: those where the nearest source surface of what is
/// shown is of that leaf.
void count_cover(const PackSurfaces& surfaces, const FrameView& view, std::span<const uint32_t> items,
                 std::span<const SceneNodeId> leaves, CoverCounts& counts);

CoverChange compare_cover(const CoverCounts& reference, const CoverCounts& shown);

}  // namespace triptych
