// Holds every drawable of a pack against the model that the pack was built from, both ways.
#pragma once

#include "model/model.hpp"
#include "scene/pack.hpp"

#include <string>
#include <vector>

namespace triptych::judge {

struct Verdict {
  uint64_t drawables = 0;         ///< that were held against their source
  uint64_t missing = 0;           ///< source triangles with an area that no leaf has at its finest level
  std::vector<std::string> lies;  ///< drawables that are further from their source than they say
  double closest = 0;  ///< the largest share of its bound that a simplified drawable was found to use
};

/// The source of a drawable: the model's own triangles, in double, that the finest drawables of its subtree's
/// leaves show, found again by their corners. `every`: one drawable of so many is judged, the root's always;
/// `steps`: how many points a side of each triangle. Meshes in memory only.
Verdict judge_pack(const Pack& pack, const Model& model, size_t every = 1, int steps = 3);

}  // namespace triptych::judge
