#include "preprocess/check/check_surfaces.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <embree3/rtcore.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

namespace triptych {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr uint64_t kept_triangles_limit = 4'000'000;

double distance_to_box(const glm::dvec3& point, const Box& box) {
  return glm::length(glm::max(glm::max(box.lo - point, point - box.hi), glm::dvec3(0)));
}

/// Whether a line comes near a box: false only where it does not, with a margin for rounding.
bool may_meet(const Box& box, const glm::dvec3& origin, const glm::dvec3& direction) {
  const glm::dvec3 from_center = (box.lo + box.hi) * 0.5 - origin;
  const double along = glm::dot(from_center, direction) / glm::dot(direction, direction);
  return glm::length(from_center - along * direction) <=
         diagonal(box) * 0.5001 + glm::length(from_center) * 1e-9;
}

}  // namespace

PackSurfaces::PackSurfaces(const Pack& pack) : pack_(pack), device_(rtcNewDevice(nullptr)) {
  if (!device_)
    fail(pack.name(), "Embree cannot make a device (error {})", static_cast<int>(rtcGetDeviceError(nullptr)));
  const Skeleton& known = pack.skeleton();
  for (const Affine& transform : known.transforms) placings_.emplace_back(transform);
  for (const SceneNode& node : known.scene_nodes) node_boxes_.push_back(known.lattice().box(node.box));
  for (const Placement& placement : known.placements) {
    const ChunkInfo& chunk = known.chunks[placement.chunk];
    const Box local = known.lattices[chunk.lattice].box(chunk.box);
    Box box;
    for (int i = 0; i < 8; ++i)
      box.extend(known.transforms[placement.transform] * glm::dvec4(local.corner(i), 1));
    placement_boxes_.push_back(box);
  }
}

PackSurfaces::~PackSurfaces() {
  trees_.clear();
  rtcReleaseDevice(device_);
}

std::shared_ptr<const ChunkTree> PackSurfaces::tree(uint32_t chunk) const {
  {
    const std::lock_guard lock(mutex_);
    const auto found = trees_.find(chunk);
    if (found != trees_.end()) {
      found->second.last_use = ++uses_;
      return found->second.tree;
    }
  }
  // Built without the lock: Embree's own tasks must not wait for it. Two threads may build the same tree; one
  // is kept.
  const ChunkInfo& info = skeleton().chunks[chunk];
  auto made =
      std::make_shared<const ChunkTree>(device_, pack_.read_chunk(chunk), skeleton().lattices[info.lattice]);
  const std::lock_guard lock(mutex_);
  const auto [entry, added] = trees_.try_emplace(chunk, Entry{made, 0});
  entry->second.last_use = ++uses_;
  if (!added) return entry->second.tree;
  kept_triangles_ += made->triangle_count();
  while (kept_triangles_ > kept_triangles_limit && trees_.size() > 1) {
    const auto oldest = std::min_element(trees_.begin(), trees_.end(), [](const auto& a, const auto& b) {
      return a.second.last_use < b.second.last_use;
    });
    kept_triangles_ -= oldest->second.tree->triangle_count();
    trees_.erase(oldest);
  }
  return made;
}

const ChunkTree& HeldTrees::of(const PackSurfaces& surfaces, uint32_t chunk) {
  Entry& entry = entries_[chunk % entries_.size()];
  if (!entry.tree || entry.chunk != chunk) entry = {chunk, surfaces.tree(chunk)};
  return *entry.tree;
}

double PackSurfaces::nearest_placement(const Drawable& drawable, const glm::dvec3& point, double best,
                                       double floor, HeldTrees* held, const HiddenObjects* hidden) const {
  for (uint32_t i = 0; i < drawable.placement_count && best > floor; ++i) {
    if (hidden && hidden->hides(drawable.scene_node, i)) continue;
    const uint32_t index = drawable.first_placement + i;
    if (distance_to_box(point, placement_boxes_[index]) >= best) continue;
    const Placement& placement = skeleton().placements[index];
    const Placing& placing = placings_[placement.transform];
    best = held ? held->of(*this, placement.chunk).distance(placing, point, best, floor)
                : tree(placement.chunk)->distance(placing, point, best, floor);
  }
  return best;
}

double PackSurfaces::distance_to_drawable(DrawableId drawable, const glm::dvec3& point, double floor,
                                          HeldTrees* held, const HiddenObjects* hidden) const {
  return nearest_placement(skeleton().drawables[drawable], point, infinite, floor, held, hidden);
}

std::optional<PackSurfaces::Hit> PackSurfaces::first_hit(DrawableId id, const glm::dvec3& origin,
                                                         const glm::dvec3& direction, double from,
                                                         const HiddenObjects* hidden) const {
  const Drawable& drawable = skeleton().drawables[id];
  std::optional<Hit> first;
  for (uint32_t i = 0; i < drawable.placement_count; ++i) {
    if (hidden && hidden->hides(drawable.scene_node, i)) continue;
    const uint32_t index = drawable.first_placement + i;
    if (drawable.placement_count > 1 && !may_meet(placement_boxes_[index], origin, direction)) continue;
    const Placement& placement = skeleton().placements[index];
    const auto chunk = tree(placement.chunk);
    const auto hit = chunk->first_hit(placings_[placement.transform], origin, direction, from);
    if (hit && (!first || hit->along < first->along))
      first = Hit{hit->along, i, hit->triangle, chunk->color(hit->triangle)};
  }
  return first;
}

void PackSurfaces::open_children(SceneNodeId id, const glm::dvec3& origin, const glm::dvec3& direction,
                                 std::vector<SceneNodeId>& open) const {
  const SceneNode& node = skeleton().scene_nodes[id];
  const auto first = static_cast<std::ptrdiff_t>(open.size());
  for (uint32_t i = 0; i < node.child_count; ++i) {
    if (may_meet(node_boxes_[node.first_child + i], origin, direction)) open.push_back(node.first_child + i);
  }
  std::sort(open.begin() + first, open.end(),  // the nearest is looked at first
            [&](SceneNodeId a, SceneNodeId b) {
              return distance_to_box(origin, node_boxes_[a]) > distance_to_box(origin, node_boxes_[b]);
            });
}

bool PackSurfaces::meets_source(const glm::dvec3& origin, const glm::dvec3& direction, double from) const {
  std::vector<SceneNodeId> open = {0};
  while (!open.empty()) {
    const SceneNodeId id = open.back();
    const SceneNode& node = skeleton().scene_nodes[id];
    open.pop_back();
    if (node.child_count > 0) {
      open_children(id, origin, direction, open);
    } else if (first_hit(node.first_drawable, origin, direction, from)) {
      return true;
    }
  }
  return false;
}

bool PackSurfaces::meets_another(SceneNodeId scene_node, const glm::dvec3& origin,
                                 const glm::dvec3& direction, double from, double reach) const {
  std::vector<SceneNodeId> open = {0};
  double nearest = reach;
  SceneNodeId leaf = no_id;
  while (!open.empty()) {
    const SceneNodeId id = open.back();
    const SceneNode& node = skeleton().scene_nodes[id];
    open.pop_back();
    if (distance_to_box(origin, node_boxes_[id]) > nearest) continue;
    if (node.child_count > 0) {
      open_children(id, origin, direction, open);
      continue;
    }
    const auto hit = first_hit(node.first_drawable, origin, direction, from);
    if (!hit || hit->along > nearest) continue;
    nearest = hit->along;
    leaf = id;
  }
  if (leaf == no_id) return false;
  while (leaf > scene_node) leaf = skeleton().scene_nodes[leaf].parent;  // a parent's id is smaller
  return leaf != scene_node;
}

bool PackSurfaces::is_enclosed(SceneNodeId scene_node, const glm::dvec3& point, double from,
                               double reach) const {
  // A little beside the axes, along which faces lie as a rule.
  const auto each_way = [](const auto& take) {
    for (int i = 0; i < 27; ++i) {
      if (i != 13 &&
          !take(glm::normalize(glm::dvec3(i % 3 - 1 + 0.013, i / 3 % 3 - 1 + 0.029, i / 9 - 1 - 0.017))))
        return false;
    }
    return true;
  };
  int escape = 0;
  return each_way([&](const glm::dvec3& way) {
           escape += !meets_source(point, way, from);
           return escape < 2;
         }) ||
         nearest_source(0, point, from, nullptr, scene_node).distance <= from ||
         !each_way(
             [&](const glm::dvec3& way) { return !meets_another(scene_node, point, way, from, reach); });
}

PackSurfaces::NearestSource PackSurfaces::nearest_source(SceneNodeId scene_node, const glm::dvec3& point,
                                                         double floor, HeldTrees* held, SceneNodeId without,
                                                         const HiddenObjects* hidden) const {
  struct Open {
    double distance;
    SceneNodeId node;
  };
  std::vector<Open> open = {{0, scene_node}};
  NearestSource best{infinite};
  while (!open.empty() && best.distance > floor) {
    const Open next = open.back();
    open.pop_back();
    if (next.distance >= best.distance || next.node == without) continue;
    const SceneNode& node = skeleton().scene_nodes[next.node];
    if (node.child_count == 0) {
      const double distance = nearest_placement(skeleton().drawables[node.first_drawable], point,
                                                best.distance, floor, held, hidden);
      if (distance < best.distance) best = {distance, next.node};
      continue;
    }
    const size_t first = open.size();
    for (uint32_t i = 0; i < node.child_count; ++i) {
      const SceneNodeId child = node.first_child + i;
      open.push_back({distance_to_box(point, node_boxes_[child]), child});
    }
    std::sort(open.begin() + static_cast<std::ptrdiff_t>(first),
              open.end(),  // the nearest is looked at first
              [](const Open& a, const Open& b) { return a.distance > b.distance; });
  }
  return best;
}

std::vector<uint32_t> PackSurfaces::source_placements(SceneNodeId scene_node) const {
  std::vector<uint32_t> placements;
  std::vector<SceneNodeId> open = {scene_node};
  while (!open.empty()) {
    const SceneNode& node = skeleton().scene_nodes[open.back()];
    open.pop_back();
    for (uint32_t i = 0; i < node.child_count; ++i) open.push_back(node.first_child + i);
    if (node.child_count > 0) continue;
    const Drawable& finest = skeleton().drawables[node.first_drawable];
    for (uint32_t i = 0; i < finest.placement_count; ++i) placements.push_back(finest.first_placement + i);
  }
  return placements;
}

}  // namespace triptych
