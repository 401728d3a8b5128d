#include "simplify/care.hpp"

#include "simplify/component_covers.hpp"
#include "simplify/scattered.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// At least this share of the cover.
constexpr double most = 0.8;
/// Bounds of wires grow by this factor.
constexpr double wire_care = 5;
/// Things that are smaller than the bound, and at most by this factor, and scattered; bounds grow by this
/// factor.
constexpr double smallest = 4, small_care = 1.45;

/// How thick the wires are that most of the cover is of; negative where it is not.
double thickness_of_wires(const std::vector<Cover>& covers) {
  double whole = 0, wires = 0, thickness = 0;
  for (const Cover& cover : covers) {
    whole += cover.covered;
    if (!cover.is_wire()) continue;
    wires += cover.covered;
    thickness += cover.covered * cover.thickness;
  }
  return wires > most * whole ? thickness / wires : -1;
}

bool are_about_as_large(const std::vector<Cover>& covers, double bound) {
  double whole = 0, small = 0;
  for (const Cover& cover : covers) {
    whole += cover.covered;
    if (cover.radius <= bound && bound <= smallest * cover.radius) small += cover.covered;
  }
  return small > most * whole;
}

}  // namespace

double bound_of_wire(double bound, double thickness) {
  return bound * wire_care > thickness ? bound * wire_care : bound;
}

void take_care_of_wires(const Surface& surface, std::span<Level> levels) {
  if (levels.empty()) return;
  const double thickness = thickness_of_wires(ComponentCovers(surface).covers);
  if (thickness < 0) return;
  for (Level& level : levels) level.bound = bound_of_wire(level.bound, thickness);
}

void take_care_of_scattered(const Surface& surface, std::span<Level> levels) {
  if (levels.empty()) return;
  const SmallThings things = scattered_things(surface);
  double last = 0;
  for (Level& level : levels) {
    if (are_about_as_large(things.covers, level.bound)) level.bound *= small_care;
    level.bound = last = std::max(last, level.bound);
  }
}

}  // namespace triptych
