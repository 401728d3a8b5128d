#include "preprocess/node_drawables.hpp"

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "preprocess/hlod.hpp"

#include <algorithm>

namespace triptych {

namespace {

/// Inner nodes of a batch, at most.
constexpr size_t batch_nodes = 256;

/// What is known of an inner node's drawables, besides their chunks.
struct HlodFigures {
  std::vector<double> errors;  ///< of each drawable
  double coarsest_error = 0;   ///< of the geometry that its parent begins with
  bool stuck = false;
};

/// What the parent of a node begins with.
struct Coarsest {
  double error = 0;
  std::vector<uint32_t> levels;  ///< of a leaf: LeafDrawable::levels of its last drawable
  SpoolPlace baked;              ///< of an inner node: its last drawable
};

}  // namespace

template <>
inline constexpr auto record_members<HlodFigures> = std::tuple(&HlodFigures::errors,
                                                               &HlodFigures::coarsest_error,
                                                               &HlodFigures::stuck);

namespace {

/// Adds a placement to the drawable, whose placements are the content's last.
void place(const Placement& placement, uint32_t triangles, NodeContent& content, Drawable& drawable) {
  content.placements.push_back(placement);
  ++drawable.placement_count;
  drawable.triangles += triangles;
}

class NodeDrawables {
 public:
  NodeDrawables(const Parts& parts, const Objects& objects, std::span<const HierarchyNode> nodes,
                std::span<const PartLevels> levels, const BuildOptions& options, BuildWork& work)
      : contents(nodes.size()),
        parts_(parts),
        objects_(objects),
        nodes_(nodes),
        levels_(levels),
        options_(options),
        work_(work),
        coarsest_(nodes.size()),
        span_file_(work.file("spans")) {
    span_borders();
  }

  void run() {
    Progress progress("hierarchical LODs", nodes_.size());
    std::vector<size_t> leaves;
    for (size_t i = 0; i < nodes_.size(); ++i) {
      if (nodes_[i].child_count == 0) leaves.push_back(i);
    }
    parallel_for(leaves.size(), [&](size_t i) { make_leaf(leaves[i]); });
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
      simplify_nodes(inner, progress);
    }
  }

  std::vector<NodeContent> contents;
  uint64_t stuck = 0;

 private:
  /// Where the points of borders are: the span of leaves that share each of them, into a file, placed part by
  /// placed part.
  void span_borders() {
    std::vector<size_t> first;  // for each instance
    size_t count = 0;
    for (const uint32_t borders : parts_.border_counts) {
      first.push_back(count);
      count += borders;
    }
    if (count == 0) return;
    std::vector<LeafSpan> spans(count);  // by instance, by number
    const auto each_border = [&](const PlacedPart& placed, const auto& take) {
      const PartInfo& part = parts_.parts[placed.part];
      if (part.borders == 0) return;
      for (const BorderPoint& border : load_borders(work_.parts(), part))
        take(spans[first[placed.instance] + border.number]);
    };
    for (const HierarchyNode& node : nodes_) {
      if (node.child_count > 0) continue;
      for (const uint32_t member : objects_.members[node.object]) {
        each_border(parts_.placed[member], [&](LeafSpan& span) {
          span.extend({node.first_place, node.first_place});
        });
      }
    }
    std::vector<LeafSpan> own;
    for (const PlacedPart& placed : parts_.placed) {
      own.clear();
      each_border(placed, [&](const LeafSpan& span) { own.push_back(span); });
      spans_.push_back(own.empty() ? 0 : span_file_.append(std::as_bytes(std::span(own))).offset);
    }
  }

  /// Of a placed part's border points.
  std::vector<LeafSpan> load_spans(uint32_t member) const {
    const uint32_t count = parts_.parts[parts_.placed[member].part].borders;
    if (count == 0) return {};
    const std::vector<std::byte> bytes = span_file_.read({spans_[member], count * sizeof(LeafSpan)});
    return ByteReader(bytes, span_file_.path().string()).read_all<LeafSpan>(count);
  }

  void make_leaf(size_t node) {
    NodeContent& content = contents[node];
    const auto& members = objects_.members[nodes_[node].object];
    for (const uint32_t member : members) content.box.extend(parts_.boxes[member]);
    auto leaf_levels = leaf_drawables(parts_, levels_, members, exit_triangles(options_));
    for (const LeafDrawable& leaf : leaf_levels) {
      Drawable drawable;
      drawable.error = leaf.error;
      drawable.first_placement = static_cast<uint32_t>(content.placements.size());
      for (size_t i = 0; i < members.size(); ++i) {
        const PlacedPart& placed = parts_.placed[members[i]];
        const PartLevel& level = levels_[placed.part].levels[leaf.levels[i]];
        place({level.chunk, placed.transform}, level.triangles, content, drawable);
      }
      content.drawables.push_back(drawable);
    }
    coarsest_[node] = {content.drawables.back().error, std::move(leaf_levels.back().levels), {}};
  }

  /// Inner nodes of one depth, ascending.
  void simplify_nodes(std::span<const uint32_t> nodes, Progress& progress) {
    for (size_t first = 0; first < nodes.size();) {
      const size_t end =
          end_of_group(first, std::min(nodes.size(), first + batch_nodes), unit_triangles(options_),
                       [&](size_t i) { return children_triangles(nodes[i]); });
      work_.run(
          UnitKind::hlod, nodes.subspan(first, end - first),
          [&](uint32_t node) { return record_bytes(simplify_children(node)); },
          [&](uint32_t node, const StoredUnit& stored) { take(node, stored); }, &progress);
      first = end;
    }
  }

  uint64_t children_triangles(size_t node) const {
    uint64_t triangles = 0;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child)
      triangles += contents[child].drawables.back().triangles;
    return triangles;
  }

  UnitResult simplify_children(uint32_t node) const {
    Hlod hlod =
        make_hlod(bake_children(node), nodes_[node].first_place, nodes_[node].end_place, parts_.lattices[0],
                  options_.hlod_triangles, options_.simplify, options_.in_pieces());
    HlodFigures figures{{}, hlod.coarsest.error, hlod.stuck};
    UnitResult result;
    for (HlodDrawable& drawable : hlod.drawables) {
      figures.errors.push_back(drawable.error);
      result.chunks.push_back({std::move(drawable.chunk), 0});
    }
    result.geometry.push_back(record_bytes(hlod.coarsest));
    result.figures = record_bytes(figures);
    return result;
  }

  Baked bake_children(uint32_t node) const {
    Baker baker(parts_.lattices[0], options_.rules);
    double error = 0;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      if (options_.rules.bounds_hold_children) error = std::max(error, coarsest_[child].error);
      if (nodes_[child].child_count == 0) {
        bake_leaf(child, baker);
      } else {
        const auto baked = load<Baked>(work_.surfaces(), coarsest_[child].baked);
        baker.add(baked.surface, baked.spans);
      }
    }
    return baker.finish(error);
  }

  /// Collects the coarsest drawable of a leaf.
  void bake_leaf(size_t leaf, Baker& baker) const {
    const auto& members = objects_.members[nodes_[leaf].object];
    for (size_t i = 0; i < members.size(); ++i) {
      const PlacedPart& placed = parts_.placed[members[i]];
      const auto part =
          load<Part>(work_.surfaces(), levels_[placed.part].surfaces[coarsest_[leaf].levels[i]]);
      std::vector<LeafSpan> spans(part.surface.points.size());
      const std::vector<LeafSpan> known = load_spans(members[i]);
      for (const BorderPoint& border : part.borders) spans[border.point] = known[border.number];
      if (placed.transform == 0) {
        baker.add(part.surface, spans);
      } else {
        const Lattice& lattice = parts_.lattices[parts_.parts[placed.part].lattice];
        baker.add(part.surface, lattice, parts_.transforms[placed.transform], spans);
      }
    }
  }

  void take(uint32_t node, const StoredUnit& stored) {
    NodeContent& content = contents[node];
    const auto figures = stored.figures_as<HlodFigures>();
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
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      content.box.extend(contents[child].box);
      coarsest_[child] = {};
    }
    // All that the node ever was lies in its box, and so do its drawables.
    const double furthest = diagonal(parts_.lattices[0].box(content.box)) * (1 + 1e-9);
    for (Drawable& drawable : content.drawables) drawable.error = std::min(drawable.error, furthest);
    coarsest_[node].error = std::min(coarsest_[node].error, furthest);
  }

  const Parts& parts_;
  const Objects& objects_;
  std::span<const HierarchyNode> nodes_;
  std::span<const PartLevels> levels_;
  const BuildOptions& options_;
  BuildWork& work_;
  std::vector<Coarsest> coarsest_;
  SpoolFile span_file_;
  std::vector<uint64_t> spans_;  ///< for each placed part where those of its border points begin
};

}  // namespace

size_t exit_triangles(const BuildOptions& options) {
  return std::max<size_t>(options.hlod_triangles / 32, 16);
}

std::vector<NodeContent> make_node_drawables(const Parts& parts, const Objects& objects,
                                             std::span<const HierarchyNode> nodes,
                                             std::span<const PartLevels> levels, const BuildOptions& options,
                                             BuildWork& work, ImportReport& report) {
  NodeDrawables drawables(parts, objects, nodes, levels, options, work);
  drawables.run();
  report.stuck_groups += drawables.stuck;
  return std::move(drawables.contents);
}

}  // namespace triptych
