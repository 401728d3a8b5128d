#include "simplify/care.hpp"

#include "simplify/component_covers.hpp"
#include "simplify/scattered.hpp"

#include <algorithm>
#include <numbers>

namespace triptych {

namespace {

/// At least this share of the cover.
constexpr double most = 0.8;
/// What is so many times as long as thick, from its middle, is a wire; bounds grow by this factor.
constexpr double wire_length = 30, wire_care = 5;
/// Things that are smaller than the bound, and at most by this factor, and scattered; bounds grow by this
/// factor.
constexpr double smallest = 4, small_care = 1.45;

bool is_wire(const Cover& cover) {
  const double across = cover.area / (4 * std::numbers::pi * cover.radius);  // a panel's is not its thickness
  return cover.radius > wire_length * across;
}

/// How thick the wires are that most of the cover is of; negative where it is not.
double thickness_of_wires(const std::vector<Cover>& covers, double whole) {
  double wires = 0, thickness = 0;
  for (const Cover& cover : covers) {
    if (!is_wire(cover)) continue;
    wires += cover.covered;
    thickness += cover.covered * cover.thickness;
  }
  return wires > most * whole ? thickness / wires : -1;
}

bool are_about_as_large(const std::vector<Cover>& covers, double whole, double bound) {
  double small = 0;
  for (const Cover& cover : covers) {
    if (cover.radius <= bound && bound <= smallest * cover.radius) small += cover.covered;
  }
  return small > most * whole;
}

}  // namespace

void take_care(const Surface& surface, Colors colors, std::vector<Level>& levels) {
  if (levels.empty()) return;
  const bool stand_apart = is_scattered(surface);
  if (colors == Colors::ignore && !stand_apart) return;
  const ComponentCovers components(surface);
  double whole = 0;
  for (const Cover& cover : components.covers) whole += cover.covered;
  const double thickness = colors == Colors::keep ? thickness_of_wires(components.covers, whole) : -1;
  double last = 0;
  for (Level& level : levels) {
    if (thickness >= 0 && level.bound > thickness) {
      level.bound *= wire_care;
    } else if (stand_apart && are_about_as_large(components.covers, whole, level.bound)) {
      level.bound *= small_care;
    }
    level.bound = last = std::max(last, level.bound);
  }
}

}  // namespace triptych
