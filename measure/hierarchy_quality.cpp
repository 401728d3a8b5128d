#include "measure/hierarchy_quality.hpp"

#include "measure/json.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// In lattice cells; boxes are inclusive.
double volume(const LatticeBox& box) {
  if (box.empty()) return 0;
  const glm::dvec3 size = glm::dvec3(box.hi) - glm::dvec3(box.lo) + 1.0;
  return size.x * size.y * size.z;
}

double shared_volume(const LatticeBox& a, const LatticeBox& b) {
  return volume({glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)});
}

}  // namespace

HierarchyQuality hierarchy_quality(const Skeleton& skeleton) {
  const auto& nodes = skeleton.scene_nodes;
  HierarchyQuality quality;
  std::vector<size_t> depth(nodes.size(), 1);
  std::vector<double> depths, balances, overlaps;
  for (size_t i = 0; i < nodes.size(); ++i) {  // parents come before their children
    const SceneNode& node = nodes[i];
    if (i > 0) depth[i] = depth[node.parent] + 1;
    quality.levels.resize(std::max(quality.levels.size(), depth[i]));
    HierarchyLevel& level = quality.levels[depth[i] - 1];
    ++level.scene_nodes;
    level.drawables += node.drawable_count;
    for (uint32_t k = 0; k < node.drawable_count; ++k)
      level.triangles += skeleton.drawables[node.first_drawable + k].triangles;
    if (node.child_count > 0) continue;
    ++level.leaves;
    depths.push_back(static_cast<double>(depth[i]));
  }
  std::vector<double> leaves(nodes.size(), 0);
  for (size_t i = nodes.size(); i-- > 0;) {  // and here children before their parents
    const SceneNode& node = nodes[i];
    if (node.child_count == 0) leaves[i] = 1;
    if (i > 0) leaves[node.parent] += leaves[i];
    if (node.child_count == 0) continue;
    const auto first = leaves.begin() + node.first_child, last = first + node.child_count;
    const auto [lightest, heaviest] = std::minmax_element(first, last);
    balances.push_back(*lightest / *heaviest);
    double shared = 0;
    for (uint32_t a = 0; a < node.child_count; ++a) {
      for (uint32_t b = a + 1; b < node.child_count; ++b)
        shared += shared_volume(nodes[node.first_child + a].box, nodes[node.first_child + b].box);
    }
    overlaps.push_back(shared / volume(node.box));
  }
  quality.depth = distribution(depths);
  quality.balance = distribution(balances);
  quality.overlap = distribution(overlaps);
  return quality;
}

nlohmann::json to_json(const HierarchyQuality& quality) {
  nlohmann::json levels = nlohmann::json::array();
  for (const HierarchyLevel& level : quality.levels) {
    levels.push_back({{"scene_nodes", level.scene_nodes},
                      {"leaves", level.leaves},
                      {"drawables", level.drawables},
                      {"triangles", level.triangles}});
  }
  return {{"depth", to_json(quality.depth)},
          {"balance", to_json(quality.balance)},
          {"overlap", to_json(quality.overlap)},
          {"levels", levels}};
}

}  // namespace triptych
