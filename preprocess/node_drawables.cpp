#include "preprocess/node_drawables.hpp"

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/held_spans.hpp"
#include "preprocess/hlod_unit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace triptych {

namespace {

/// Inner nodes of a batch, at most.
constexpr size_t batch_nodes = 256;

struct RootFigures {
  double error = 0;
};

/// What the parent of a node begins with.
struct Coarsest {
  double error = 0;
  uint32_t triangles = 0;
  std::vector<uint32_t> levels;     ///< of a leaf of parts: LeafDrawable::levels of its last drawable
  SpoolPlace baked;                 ///< otherwise: the last drawable of the node, or of what it stands for
  std::vector<ErrorGap> gaps = {};  ///< PartInfo::gaps of all parts in it, model units
};

}  // namespace

template <>
inline constexpr auto record_members<RootFigures> = std::tuple(&RootFigures::error);

namespace {

/// Adds a placement to the drawable, whose placements are the content's last.
void place(const Placement& placement, uint32_t triangles, NodeContent& content, Drawable& drawable) {
  content.placements.push_back(placement);
  ++drawable.placement_count;
  drawable.triangles += triangles;
}

class NodeDrawables {
 public:
  NodeDrawables(const Parts& parts, const PlacedParts& placed, const Objects& objects,
                std::span<const HierarchyNode> nodes, std::span<const PartLevels> levels,
                std::span<const HierarchyRoot> roots, const BuildOptions& options, BuildWork& work)
      : contents(nodes.size()),
        parts_(parts),
        placed_(placed),
        lattice_(parts.lattices[placed.lattice]),
        objects_(objects),
        nodes_(nodes),
        levels_(levels),
        roots_(roots),
        options_(options),
        work_(work),
        coarsest_(nodes.size()),
        held_(parts, placed, leaf_places(objects, nodes, placed.placed.size()), work) {}

  void run(Progress& progress) {
    std::vector<size_t> leaves;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].child_count == 0) leaves.push_back(i);
    }
    parallel_for(leaves.size(), [&](size_t i) {
      if (stands_for(leaves[i]) == no_id) {
        make_leaf(leaves[i]);
      } else {
        make_instance(leaves[i]);
      }
    });
    progress.advance(leaves.size());
    // From the deepest level up. Nodes are in breadth-first order: those of one depth are contiguous.
    std::vector<uint32_t> depths(nodes_.size(), 0);
    for (size_t i = 1; i < nodes_.size(); ++i) depths[i] = depths[nodes_[i].parent] + 1;
    for (size_t end = nodes_.size(); end > 0;) {
      const uint32_t depth = depths[end - 1];
      std::vector<uint32_t> inner;
      for (; end > 0 && depths[end - 1] == depth; --end) {
        if (nodes_[end - 1].child_count > 0) inner.push_back(static_cast<uint32_t>(end - 1));
      }
      std::reverse(inner.begin(), inner.end());
      const auto moving =
          std::stable_partition(inner.begin(), inner.end(), [&](uint32_t i) { return !holds_moving(i); });
      for (auto node = moving; node != inner.end(); ++node) surround(*node);
      progress.advance(static_cast<uint64_t>(inner.end() - moving));
      simplify_nodes({inner.begin(), moving}, progress);
    }
  }

  /// What replaces the whole hierarchy where it is placed; after run().
  HierarchyRoot root() {
    const Coarsest& coarsest = coarsest_[0];
    HierarchyRoot root{contents[0].box, coarsest.error, coarsest.triangles, coarsest.baked};
    if (nodes_[0].child_count > 0) return root;
    constexpr uint32_t index = 0;
    work_.run(
        UnitKind::root_geometry, std::span(&index, 1),
        [&](uint32_t node) {
          std::vector<HlodSource> sources;
          add_sources(node, sources);
          const Baked baked = bake(sources, coarsest.error, hlod_place());
          return record_bytes(UnitResult{{}, {record_bytes(baked)}, record_bytes(RootFigures{baked.error})});
        },
        [&](uint32_t, const StoredUnit& stored) {
          root.error = stored.figures_as<RootFigures>().error;
          root.baked = stored.geometry.at(0);
        });
    return root;
  }

  std::vector<NodeContent> contents;
  uint64_t stuck = 0;

 private:
  uint32_t stands_for(size_t node) const { return sub_hierarchy_of(nodes_[node], objects_); }
  bool is_leaf_of_parts(size_t node) const {
    return nodes_[node].child_count == 0 && stands_for(node) == no_id;
  }

  /// Whether something below moves, or the leaf does. Those above inherit it.
  bool holds_moving(size_t node) {
    if (objects_.moving.empty()) return false;
    const HierarchyNode& of = nodes_[node];
    if (of.child_count == 0) return objects_.moving[of.object];
    if (holds_moving_.empty()) holds_moving_.resize(nodes_.size(), false);
    bool moves = false;
    for (uint32_t child = of.first_child; child < of.first_child + of.child_count; ++child)
      moves = moves || (nodes_[child].child_count == 0 ? holds_moving(child) : holds_moving_[child]);
    holds_moving_[node] = moves;
    return moves;
  }

  /// Nothing stands for what moves: the scene node above is a box alone.
  void surround(uint32_t node) {
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      contents[node].box.extend(contents[child].box);
      coarsest_[node].error = std::max(coarsest_[node].error, coarsest_[child].error);
      coarsest_[child] = {};
    }
  }

  void make_leaf(size_t node) {
    NodeContent& content = contents[node];
    const auto& members = objects_.members[nodes_[node].object];
    for (const uint32_t member : members) content.box.extend(placed_.boxes[member]);
    auto leaf_levels = leaf_drawables(placed_, levels_, members, exit_triangles(options_));
    for (const LeafDrawable& leaf : leaf_levels) {
      Drawable drawable;
      drawable.error = leaf.error;
      drawable.first_placement = static_cast<uint32_t>(content.placements.size());
      for (size_t i = 0; i < members.size(); ++i) {
        const PlacedPart& placed = placed_.placed[members[i]];
        const PartLevel& level = levels_[placed.part].levels[leaf.levels[i]];
        place({level.chunk, placed.transform}, level.triangles, content, drawable);
        if (level.grown > 0) content.box.extend(box_of(members[i], level));
      }
      content.drawables.push_back(drawable);
    }
    const Drawable& last = content.drawables.back();
    coarsest_[node] = {last.error, last.triangles, std::move(leaf_levels.back().levels), {}};
    for (const uint32_t member : members) {
      const PlacedPart& placed = placed_.placed[member];
      add_gaps(parts_.parts[placed.part].gaps, placed_.stretches[placed.transform], coarsest_[node].gaps);
    }
    join_gaps(coarsest_[node].gaps);
  }

  /// Of a placed part at a level, which may be enlarged beyond the part's box.
  LatticeBox box_of(uint32_t member, const PartLevel& level) const {
    const double stretch = placed_.stretches[placed_.placed[member].transform];
    const int margin = static_cast<int>(std::ceil(level.grown * stretch * (1 + 1e-9) / lattice_.step)) + 1;
    LatticeBox box = placed_.boxes[member];
    box.lo -= margin;
    box.hi += margin;
    return box;
  }

  /// A leaf that stands for a sub-hierarchy: it draws the sub-hierarchy's own drawables.
  void make_instance(size_t node) {
    const PlannedSubHierarchy& placed = placed_.sub_hierarchies[stands_for(node)];
    const HierarchyRoot& root = roots_[placed.hierarchy];
    LatticeBox& enclosing = contents[node].box;
    enclosing = lattice_.enclosing(
        box_at_all_times(parts_.motion, placed, placed_.transforms, lattice_of(placed).box(root.box)));
    enclosing.lo -= 1;  // rounding in the transform
    enclosing.hi += 1;
    coarsest_[node] = {root.error * placed_.stretches[placed.transform], root.triangles, {}, root.baked};
  }

  const Lattice& lattice_of(const PlannedSubHierarchy& placed) const {
    return parts_.lattices[parts_.hierarchies[placed.hierarchy].lattice];
  }

  /// Inner nodes of one depth, ascending.
  void simplify_nodes(std::span<const uint32_t> nodes, Progress& progress) {
    for (size_t first = 0; first < nodes.size();) {
      const size_t end =
          end_of_group(first, std::min(nodes.size(), first + batch_nodes), unit_triangles(options_),
                       [&](size_t i) { return children_triangles(nodes[i]); });
      work_.run(
          UnitKind::hlod, nodes.subspan(first, end - first),
          [&](uint32_t node) {
            const HierarchyNode& own = nodes_[node];
            return record_bytes(hlod_unit(sources_of_children(node), error_of_children(node), own.first_place,
                                          own.end_place, gaps_of_children(node), hlod_place()));
          },
          [&](uint32_t node, const StoredUnit& stored) { take(node, stored); }, &progress);
      first = end;
    }
  }

  uint64_t children_triangles(size_t node) const {
    uint64_t triangles = 0;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child)
      triangles += coarsest_[child].triangles;
    return triangles;
  }

  std::vector<ErrorGap> gaps_of_children(uint32_t node) const {
    std::vector<ErrorGap> gaps;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child)
      add_gaps(coarsest_[child].gaps, 1, gaps);
    join_gaps(gaps);
    return gaps;
  }

  HlodPlace hlod_place() const {
    return {options_, lattice_, parts_.palette_view(), placed_.lattice, parts_.has_objects};
  }

  double error_of_children(uint32_t node) const {
    double error = 0;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      if (options_.rules.bounds_hold_children) error = std::max(error, coarsest_[child].error);
    }
    return error;
  }

  std::vector<HlodSource> sources_of_children(uint32_t node) const {
    std::vector<HlodSource> sources;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child)
      add_sources(child, sources);
    return sources;
  }

  /// The coarsest geometry of a node. A placed sub-hierarchy has no borders with what is around it.
  void add_sources(size_t node, std::vector<HlodSource>& sources) const {
    if (is_leaf_of_parts(node)) return add_parts(node, sources);
    auto baked = load<Baked>(work_.surfaces(), coarsest_[node].baked);
    HlodSource& source = sources.emplace_back();
    source.surface = std::move(baked.surface);
    source.objects = std::move(baked.objects);
    source.seen_from_outside = baked.seen_from_outside;
    if (nodes_[node].child_count > 0) {
      source.spans = std::move(baked.spans);
      return;
    }
    const PlannedSubHierarchy& placed = placed_.sub_hierarchies[stands_for(node)];
    source.spans.resize(source.surface.points.size());
    for (SourceObjectId& object : source.objects) object = object_in(placed.first_object, object);
    // What is covered in there was measured in its own steps.
    for (Triangle& triangle : source.surface.triangles) triangle.material = material_seen(triangle.material);
    source.lattice = &lattice_of(placed);
    source.transform = placed_.transforms[placed.transform];
  }

  /// The coarsest drawable of a leaf.
  void add_parts(size_t leaf, std::vector<HlodSource>& sources) const {
    const auto& members = objects_.members[nodes_[leaf].object];
    for (size_t i = 0; i < members.size(); ++i) {
      const PlacedPart& placed = placed_.placed[members[i]];
      auto part = load<Part>(work_.surfaces(), levels_[placed.part].surfaces[coarsest_[leaf].levels[i]]);
      HlodSource& source = sources.emplace_back();
      source.spans.resize(part.surface.points.size());
      const std::vector<LeafSpan> known = held_.load(members[i]);
      for (const BorderPoint& border : part.borders) source.spans[border.point] = known[border.number];
      if (parts_.has_objects)
        source.objects.assign(part.surface.triangles.size(), placed_.objects[placed.instance]);
      source.surface = std::move(part.surface);
      source.seen_from_outside = part.seen_from_outside;
      if (placed.transform == 0) continue;
      source.lattice = &parts_.lattices[parts_.parts[placed.part].lattice];
      source.transform = placed_.transforms[placed.transform];
    }
  }

  void take(uint32_t node, const StoredUnit& stored) {
    NodeContent& content = contents[node];
    auto figures = stored.figures_as<HlodFigures>();
    stuck += figures.stuck;
    coarsest_[node].error = figures.coarsest_error;
    coarsest_[node].baked = stored.geometry.at(0);
    for (uint32_t i = 0; i < stored.chunks.size(); ++i) {
      Drawable drawable;
      drawable.error = figures.errors.at(i);
      drawable.first_placement = static_cast<uint32_t>(content.placements.size());
      place({stored.first_chunk + i, 0}, stored.chunks[i].triangle_count, content, drawable);
      content.drawables.push_back(drawable);
      content.box.extend(stored.chunks[i].box);
    }
    content.triangle_objects = std::move(figures.objects);
    coarsest_[node].gaps = gaps_of_children(node);
    const uint64_t of_children = children_triangles(node);
    double children = 0;  // the largest error of one
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      content.box.extend(contents[child].box);
      children = std::max(children, coarsest_[child].error);
      coarsest_[child] = {};
    }
    // The source and all drawables lie in the node's box, so no distance is larger than its diagonal. But
    // bounds must not shrink, and that of a stretched sub-hierarchy may be larger.
    const double furthest = std::max(diagonal(lattice_.box(content.box)) * (1 + 1e-9), children);
    for (Drawable& drawable : content.drawables) drawable.error = std::min(drawable.error, furthest);
    coarsest_[node].error = std::min(coarsest_[node].error, furthest);
    coarsest_[node].triangles =
        static_cast<uint32_t>(content.drawables.empty() ? of_children : content.drawables.back().triangles);
  }

  const Parts& parts_;
  const PlacedParts& placed_;
  const Lattice& lattice_;
  const Objects& objects_;
  std::span<const HierarchyNode> nodes_;
  std::span<const PartLevels> levels_;
  std::span<const HierarchyRoot> roots_;
  const BuildOptions& options_;
  BuildWork& work_;
  std::vector<Coarsest> coarsest_;
  std::vector<bool> holds_moving_;  ///< inner nodes; empty until the first is looked at
  HeldSpans held_;
};

}  // namespace

size_t exit_triangles(const BuildOptions& options) {
  return std::max<size_t>(options.hlod_triangles / 32, 16);
}

std::vector<uint32_t> leaf_places(const Objects& objects, std::span<const HierarchyNode> nodes,
                                  size_t placed) {
  std::vector<uint32_t> places(placed, 0);
  for (const HierarchyNode& node : nodes) {
    if (node.child_count > 0 || node.object >= objects.members.size()) continue;
    for (const uint32_t member : objects.members[node.object]) places[member] = node.first_place;
  }
  return places;
}

uint32_t sub_hierarchy_of(const HierarchyNode& node, const Objects& objects) {
  if (node.child_count > 0 || node.object < objects.members.size()) return no_id;
  return objects.sub_hierarchies[node.object - objects.members.size()];
}

HierarchyDrawables make_node_drawables(const Parts& parts, uint32_t hierarchy, const Objects& objects,
                                       std::span<const HierarchyNode> nodes,
                                       std::span<const PartLevels> levels,
                                       std::span<const HierarchyRoot> roots, const BuildOptions& options,
                                       BuildWork& work, Progress& progress, ImportReport& report) {
  if (nodes.empty()) return {};
  NodeDrawables drawables(parts, parts.hierarchies[hierarchy], objects, nodes, levels, roots, options, work);
  drawables.run(progress);
  report.stuck_groups += drawables.stuck;
  HierarchyRoot root;
  if (hierarchy + 1 < parts.hierarchies.size()) root = drawables.root();
  return {std::move(drawables.contents), root};
}

}  // namespace triptych
