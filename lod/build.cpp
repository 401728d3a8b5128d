#include "lod/build.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/progress.hpp"
#include "base/threads.hpp"
#include "lod/hlod.hpp"
#include "lod/leaf.hpp"
#include "lod/objects.hpp"
#include "lod/parts.hpp"
#include "scene/hierarchy.hpp"
#include "scene/pack.hpp"

#include <algorithm>
#include <limits>

namespace triptych {

namespace {

/// What a scene node holds before the skeleton is put together.
struct NodeContent {
  LatticeBox box;
  std::vector<Drawable> drawables;  ///< placements: of `placements`
  std::vector<Placement> placements;
  double error = 0;                   ///< of the last drawable
  std::vector<uint32_t> exit_levels;  ///< of a leaf: LeafDrawable::levels of the last drawable
  Baked coarsest;                     ///< of an inner node: the last drawable, until the parent has taken it
};

class Builder {
 public:
  Builder(Model& model, const BuildOptions& options, const std::filesystem::path& file)
      : options_(options), writer_(file) {
    skeleton_.import = std::move(model.report);
    skeleton_.source_triangles = model.source_triangles();
    skeleton_.placed_triangles = model.placed_triangles();
    report_.source_triangles = skeleton_.source_triangles;
    report_.placed_triangles = skeleton_.placed_triangles;
  }

  BuildReport run(Model& model, const std::filesystem::path& file) {
    stage("weld and partition", [&] { parts_ = make_parts(model, options_, skeleton_.import); });
    model = {};
    std::vector<LatticeBox> boxes(parts_.placed.size());
    stage("cluster and partition", [&] {
      parallel_for(boxes.size(), [&](size_t i) { boxes[i] = placed_box(parts_, parts_.placed[i]); });
      objects_ = make_objects(parts_, boxes, options_);
    });
    stage("hierarchy", [&] { make_nodes(boxes); });
    stage("leaf LODs",
          [&] { levels_ = make_part_levels(parts_, exit_triangles(), writer_, skeleton_.import); });
    stage("HLODs", [&] { make_drawables(); });
    stage("write", [&] { finish(); });
    report_.import = skeleton_.import;
    report_.pack_bytes = std::filesystem::file_size(file);
    return std::move(report_);
  }

 private:
  template <typename Work>
  void stage(const std::string& name, const Work& work) {
    const Stopwatch stopwatch;
    work();
    report_.stages.push_back({name, stopwatch.seconds()});
  }

  void make_nodes(std::span<const LatticeBox> boxes) {
    nodes_ = build_hierarchy(objects_.boxes);
    contents_.resize(nodes_.size());
    for (size_t i = nodes_.size(); i-- > 0;) {
      if (nodes_[i].child_count == 0) {
        for (const uint32_t member : objects_.members[nodes_[i].object])
          contents_[i].box.extend(boxes[member]);
      }
      if (nodes_[i].parent != no_id) contents_[nodes_[i].parent].box.extend(contents_[i].box);
    }
    // Where the points of borders are: instance by instance, the span of leaves that share each of them.
    border_spans_.resize(parts_.border_counts.size());
    for (size_t i = 0; i < border_spans_.size(); ++i) border_spans_[i].resize(parts_.border_counts[i]);
    for (const HierarchyNode& node : nodes_) {
      if (node.child_count > 0) continue;
      for (const uint32_t member : objects_.members[node.object]) {
        const PlacedPart& placed = parts_.placed[member];
        for (const uint32_t border : parts_.parts[placed.part].borders) {
          if (border != no_border) {
            border_spans_[placed.instance][border].extend({node.first_place, node.first_place});
          }
        }
      }
    }
  }

  /// Drawables from the deepest level of the hierarchy up; the nodes of one level side by side.
  void make_drawables() {
    Progress progress("hierarchical LODs", nodes_.size());
    std::vector<uint32_t> depths(nodes_.size(), 0);
    for (size_t i = 1; i < nodes_.size(); ++i) depths[i] = depths[nodes_[i].parent] + 1;
    // Breadth first: the nodes of one depth are contiguous.
    size_t end = nodes_.size();
    while (end > 0) {
      size_t first = end;
      while (first > 0 && depths[first - 1] == depths[end - 1]) --first;
      constexpr size_t batch = 1024;
      for (size_t start = first; start < end; start += batch) {
        std::vector<Hlod> hlods(std::min(batch, end - start));
        parallel_for(hlods.size(), [&](size_t i) {
          if (nodes_[start + i].child_count > 0) {
            hlods[i] = simplify_children(start + i);
          } else {
            make_leaf(start + i);
          }
          progress.advance();
        });
        for (size_t i = 0; i < hlods.size(); ++i) {
          if (nodes_[start + i].child_count > 0) take(start + i, std::move(hlods[i]));
        }
      }
      end = first;
    }
  }

  /// Drawables of fewer triangles than this cost more to handle than to draw: a leaf has none beyond its
  /// first.
  size_t exit_triangles() const { return std::max<size_t>(options_.hlod_triangles / 32, 16); }

  void make_leaf(size_t node) {
    NodeContent& content = contents_[node];
    const auto& members = objects_.members[nodes_[node].object];
    auto leaf_levels = leaf_drawables(parts_, levels_, members, exit_triangles());
    for (const LeafDrawable& leaf : leaf_levels) {
      Drawable drawable;
      drawable.error = leaf.error;
      drawable.triangles = leaf.triangles;
      drawable.first_placement = static_cast<uint32_t>(content.placements.size());
      drawable.placement_count = static_cast<uint32_t>(members.size());
      for (size_t i = 0; i < members.size(); ++i) {
        const PlacedPart& placed = parts_.placed[members[i]];
        content.placements.push_back({levels_[placed.part].levels[leaf.levels[i]].chunk, placed.transform});
      }
      content.drawables.push_back(drawable);
    }
    content.error = content.drawables.back().error;
    content.exit_levels = std::move(leaf_levels.back().levels);
  }

  Hlod simplify_children(size_t node) {
    Baker baker(parts_.lattices[0]);
    double error = 0;
    const uint32_t first = nodes_[node].first_child;
    for (uint32_t child = first; child < first + nodes_[node].child_count; ++child) {
      error = std::max(error, contents_[child].error);
      if (nodes_[child].child_count == 0) {
        bake_leaf(child, baker);
      } else {
        baker.add(contents_[child].coarsest.surface, contents_[child].coarsest.spans);
        contents_[child].coarsest = {};
      }
    }
    return make_hlod(baker.finish(error), nodes_[node].first_place, nodes_[node].end_place,
                     parts_.lattices[0], options_.hlod_triangles);
  }

  /// Collects the coarsest drawable of a leaf.
  void bake_leaf(size_t leaf, Baker& baker) const {
    const auto& members = objects_.members[nodes_[leaf].object];
    for (size_t i = 0; i < members.size(); ++i) {
      const PlacedPart& placed = parts_.placed[members[i]];
      const Part& part = levels_[placed.part].surfaces[contents_[leaf].exit_levels[i]];
      std::vector<LeafSpan> spans(part.surface.points.size());
      for (size_t point = 0; point < part.borders.size(); ++point) {
        const uint32_t border = part.borders[point];
        if (border != no_border) spans[point] = border_spans_[placed.instance][border];
      }
      if (placed.transform == 0) {
        baker.add(part.surface, spans);
      } else {
        baker.add(part.surface, parts_.lattices[part.lattice], parts_.transforms[placed.transform], spans);
      }
    }
  }

  void take(size_t node, Hlod hlod) {
    NodeContent& content = contents_[node];
    for (const HlodDrawable& level : hlod.drawables) {
      Drawable drawable;
      drawable.error = level.error;
      drawable.triangles = level.chunk.triangles;
      drawable.first_placement = static_cast<uint32_t>(content.placements.size());
      drawable.placement_count = 1;
      content.placements.push_back({append(writer_, level.chunk, 0), 0});
      content.drawables.push_back(drawable);
      content.box.extend(level.chunk.box);
    }
    content.coarsest = std::move(hlod.coarsest);
    content.error = content.coarsest.error;
    if (nodes_[node].parent != no_id) contents_[nodes_[node].parent].box.extend(content.box);
    skeleton_.import.stuck_groups += hlod.stuck;
  }

  void finish() {
    skeleton_.lattices = std::move(parts_.lattices);
    skeleton_.transforms = std::move(parts_.transforms);
    skeleton_.palette = std::move(parts_.palette);
    skeleton_.objects = objects_.counts;
    for (uint32_t i = 0; i < nodes_.size(); ++i) {
      const HierarchyNode& node = nodes_[i];
      const NodeContent& content = contents_[i];
      skeleton_.scene_nodes.push_back({content.box, node.parent, node.first_child, node.child_count,
                                       static_cast<DrawableId>(skeleton_.drawables.size()),
                                       static_cast<uint32_t>(content.drawables.size())});
      const auto first = static_cast<uint32_t>(skeleton_.placements.size());
      for (Drawable drawable : content.drawables) {
        drawable.scene_node = i;
        drawable.first_placement += first;
        skeleton_.drawables.push_back(drawable);
      }
      skeleton_.placements.insert(skeleton_.placements.end(), content.placements.begin(),
                                  content.placements.end());
    }
    report_.drawables = skeleton_.drawables.size();
    writer_.finish(skeleton_);
  }

  const BuildOptions options_;
  PackWriter writer_;
  Skeleton skeleton_;
  BuildReport report_;
  Parts parts_;
  Objects objects_;
  std::vector<HierarchyNode> nodes_;
  std::vector<NodeContent> contents_;
  std::vector<std::vector<LeafSpan>> border_spans_;  ///< by instance, by border number
  std::vector<PartLevels> levels_;
};

}  // namespace

BuildReport build_pack(Model model, const BuildOptions& options, const std::filesystem::path& file) {
  if (model.source_triangles() == 0 || model.instances.empty())
    fail(file.string(), "the model holds no triangles");
  return Builder(model, options, file).run(model, file);
}

}  // namespace triptych
