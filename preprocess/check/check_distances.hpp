// How far the drawables of a pack are from their source, the finest leaf drawables of their subtree, and what
// they leave out of it.
#pragma once

#include "scene/pack.hpp"

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace triptych {

/// Whether the drawable is the finest one of a leaf: part of the source that others are compared with.
bool is_source(const Skeleton& skeleton, DrawableId id);

/// For each drawable one that is as far from its source: itself, or the one with the same local id in another
/// instance of the sub-hierarchy, whose transform differs only by a rigid motion or a mirror image.
std::vector<DrawableId> equally_distant(const Skeleton& skeleton);

/// Up to which distances are rounding, of coordinates as large as the model's.
double distance_rounding(const Skeleton& skeleton);

/// What was found of a drawable and its source.
struct MeasuredDrawable {
  /// The largest two-sided distance; 0 for the source itself, NaN where a chunk is damaged. What is left out
  /// and hidden does not count.
  double distance = 0;
  /// A place of the source that is further from the drawable than its error, and hidden.
  std::optional<glm::dvec3> left_out{};
  /// Such a place from which everything that is not of the drawable's scene node is further away, too.
  std::optional<glm::dvec3> uncovered{};
};

/// At about `points` points over all drawables. Distances are lower bounds of the true ones, the same for the
/// same pack.
std::vector<MeasuredDrawable> measured_drawables(const Pack& pack, uint64_t points);

/// The distances of the given drawables alone, in their order. `between` is called now and then, by
/// any thread; if it throws an Error on this and each later call, the measurement ends.
std::vector<double> measured_distances(
    const Pack& pack, std::span<const DrawableId> drawables, uint64_t points,
    const std::function<void()>& between = [] {});

}  // namespace triptych
