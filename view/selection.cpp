#include "view/selection.hpp"

#include "lod/frame_view.hpp"
#include "scene/finest_boxes.hpp"
#include "scene/object_text.hpp"

#include <cmath>
#include <fmt/core.h>

namespace triptych {

bool same_thing(const Selection& a, const Selection& b) {
  if (a.object != b.object) return false;
  if (a.object != no_id) return true;
  const auto place = [](const Selection& s) {
    return s.picked ? std::pair(s.picked->drawable, s.picked->placement) : std::pair(no_id, 0u);
  };
  return place(a) == place(b);
}

const PackObjects& Selector::objects() {
  if (!objects_) objects_.emplace(pack_.read_objects());
  return *objects_;
}

std::vector<SourceObjectId> Selector::parts_of(SourceObjectId object) {
  if (!objects().nodes_of(object).empty()) return {object};
  const SourceObjects& source = objects().source();
  std::vector<bool> within(source.objects.size());
  within[object] = true;
  std::vector<SourceObjectId> parts;
  for (SourceObjectId id = object + 1; id < source.objects.size(); ++id) {  // parents come first
    const SourceObjectId parent = source.objects[id].parent;
    within[id] = parent != no_id && within[parent];
    if (within[id] && !objects().nodes_of(id).empty()) parts.push_back(id);
  }
  return parts;
}

void Selector::add_placement(SceneNodeId leaf, uint32_t placement, Selection& selection) const {
  const Skeleton& skeleton = pack_.skeleton();
  const Drawable& finest = skeleton.drawables[skeleton.scene_nodes[leaf].first_drawable];
  selection.box.extend(placement_box(skeleton, leaf, placement));
  selection.triangles +=
      skeleton.chunks[skeleton.placements[finest.first_placement + placement].chunk].triangle_count;
}

void Selector::add_object(SourceObjectId object, Selection& selection) {
  selection.object = object;
  selection.text += object_text(objects(), object);
  const SourceObjects& source = objects().source();
  const SourceObject& known = source.objects[object];
  for (const uint32_t text : {known.name, known.type, known.guid}) {
    if (text == 0) continue;
    selection.name = in_one_cell(source.texts[text], 60);
    break;
  }
  selection.box = {};
  selection.triangles = 0;
  for (const SourceObjectId part : parts_of(object)) {
    for (const SceneNodeId leaf : objects().nodes_of(part)) {
      const LeafRuns of_leaf = objects().stored_runs_of(leaf);
      uint32_t placement = 0;
      for (const ObjectRun& run : of_leaf.runs) {
        const bool own = object_in(of_leaf.first_object, run.object) == part;
        for (uint32_t i = 0; i < run.placements; ++i, ++placement) {
          if (own) add_placement(leaf, placement, selection);
        }
      }
    }
  }
}

Selection Selector::describe(SourceObjectId object) {
  Selection selection;
  selection.name = fmt::format("object {}", object);
  add_object(object, selection);
  return selection;
}

Selection Selector::describe(const Picked& picked, const FrameState& frame) {
  const Skeleton& skeleton = pack_.skeleton();
  const Drawable& drawable = skeleton.drawables[picked.drawable];
  const SceneNode& node = skeleton.scene_nodes[drawable.scene_node];
  const FrameView view(skeleton, frame);
  const double pixels = projected_error(view.focal_length, drawable.error, view.eye_space.bounds(node.box));
  Selection selection;
  selection.name = fmt::format("drawable {}", picked.drawable);
  if (node.child_count == 0) {
    // All drawables of a leaf place the same parts in the same order.
    add_placement(drawable.scene_node, picked.placement, selection);
  } else {
    selection.box = skeleton.lattice().box(node.box);
    selection.triangles = skeleton.drawables[node.first_drawable].triangles;
  }
  selection.text = fmt::format(
      "at {:.6g}, {:.6g}, {:.6g}: drawable {} of scene node {}, level {} of {} (0 is the finest), off by at "
      "most "
      "{:.3g} model units{}\n",
      picked.point.x, picked.point.y, picked.point.z, picked.drawable, drawable.scene_node,
      picked.drawable - node.first_drawable, node.drawable_count, drawable.error,
      std::isfinite(pixels) ? fmt::format(", {:.3g} px", pixels) : "");
  selection.picked = picked;
  const SourceObjectId object = objects().object_at(picked.drawable, picked.placement, picked.triangle);
  if (object != no_id) add_object(object, selection);
  return selection;
}

}  // namespace triptych
