#include "lod/cut.hpp"

#include "base/rounding.hpp"
#include "scene/seen_from_outside.hpp"

#include <algorithm>
#include <cmath>

namespace triptych {

namespace {

/// The drawable's error, as the rules believe it.
double error_of(const FrameView& view, const SceneNode& node, DrawableId id) {
  const Skeleton& skeleton = *view.skeleton;
  double error = skeleton.drawables[id].error;
  if (view.rules.bounds_hold_children || node.child_count == 0) return error;
  double of_children = 0;
  for (uint32_t child = 0; child < node.child_count; ++child) {
    const SceneNode& below = skeleton.scene_nodes[node.first_child + child];
    if (below.drawable_count == 0) continue;
    const DrawableId coarsest = below.first_drawable + below.drawable_count - 1;
    of_children = std::max(of_children, skeleton.drawables[coarsest].error);
  }
  return std::max(error - of_children, 0.0);
}

/// Whether what a drawable leaves out, since others cover it, may be seen: the near plane may cut its box
/// open, or what covers it is hidden or cut away, which is no further from it than its error.
bool shows_what_it_lacks(const FrameView& view, const LatticeBox& box, const Drawable& drawable) {
  if (!view.rules.levels_from_outside || !is_seen_from_outside(*view.skeleton, drawable)) return false;
  if (!view.eye_space.is_beyond_near(box)) return true;
  if (!view.state.hiding.objects && view.section_space.keeps_all()) return false;
  const double steps = std::ceil(drawable.error / view.skeleton->lattice().step) + 1;
  const int reach = static_cast<int>(std::min(steps, 0x1p29));
  const LatticeBox around{box.lo - reach, box.hi + reach};
  if (!view.section_place(around).inside()) return true;
  return view.state.hiding.objects && view.state.hiding.objects->touches(around);
}

/// The coarsest drawable of the node that keeps the pixel error, or no_id.
DrawableId coarsest(const FrameView& view, const SceneNode& node, const LatticeBox& box,
                    const EyeBounds& bounds) {
  for (uint32_t level = node.drawable_count; level-- > 0;) {
    const DrawableId id = node.first_drawable + level;
    const double error = error_of(view, node, id);
    if (projected_error(view.focal_length, error, bounds) > view.state.pixel_error) continue;
    if (!shows_what_it_lacks(view, box, view.skeleton->drawables[id])) return id;
  }
  return no_id;
}

[[gnu::noinline]] DrawableId choose(const FrameView& view, SceneNodeId id, FrustumCulling culling) {
  const Skeleton& skeleton = *view.skeleton;
  const SceneNode& node = skeleton.scene_nodes[id];
  const HiddenShare hidden = view.hidden(id);
  if (hidden == HiddenShare::all) return no_id;
  if (view.moves(id)) {
    // What cannot come into view at any time is not evaluated.
    if (culling == FrustumCulling::on && view.eye_space.bounds(node.box).outside) return no_id;
    if (!view.poses->is_there(id)) return no_id;
  }
  const SectionPlace place = view.section_place(view.reach(id));
  if (place.outside) return no_id;
  const LatticeBox box = view.box(id);
  EyeBounds bounds = view.eye_space.bounds(box);
  if (bounds.outside) {
    if (culling == FrustumCulling::on) return no_id;
    bounds.min_depth =
        std::sqrt(static_cast<double>(squared_distance(view.cell, box))) * skeleton.lattice().step;
    bounds.stretch = 1;
  }
  // No drawable of it leaves out what is hidden; those of leaves do, placement by placement.
  if (hidden == HiddenShare::some && node.child_count > 0) return Cut::inner;
  // Simplified solids are often not closed any more: where something is cut, it and all chunks that its
  // surface was divided among are drawn as they are, and those that are cut away, too: they may hold the cap.
  const bool may_be_coarse = view.state.pixel_error > 0 && place.inside();
  const DrawableId chosen = may_be_coarse ? coarsest(view, node, box, bounds) : no_id;
  if (chosen != no_id) return chosen;
  return node.child_count == 0 ? node.first_drawable : Cut::inner;
}

/// Calls found(node, choice) for every scene node that the cut reaches, from the root down.
template <typename Found>
void walk(const FrameView& view, FrustumCulling culling, std::vector<SceneNodeId>& open, const Found& found) {
  const NearestRounding rounding;
  open.assign(1, 0);
  while (!open.empty()) {
    const SceneNodeId id = open.back();
    open.pop_back();
    const DrawableId choice = choose(view, id, culling);
    if (choice == no_id) continue;
    found(id, choice);
    if (choice != Cut::inner) continue;
    const SceneNode& node = view.skeleton->scene_nodes[id];
    for (uint32_t child = 0; child < node.child_count; ++child) open.push_back(node.first_child + child);
  }
}

}  // namespace

DrawableId choose_level(const FrameView& view, SceneNodeId node, FrustumCulling culling) {
  const NearestRounding rounding;
  return choose(view, node, culling);
}

bool may_stand_for_node(const FrameView& view, DrawableId id) {
  const NearestRounding rounding;
  const Skeleton& skeleton = *view.skeleton;
  const SceneNodeId of = skeleton.drawables[id].scene_node;
  const SceneNode& node = skeleton.scene_nodes[of];
  if (node.child_count == 0 && id == node.first_drawable) return true;
  if (node.child_count > 0 && view.hidden(of) != HiddenShare::nothing) return false;
  return view.section_place(view.reach(of)).inside() &&
         !shows_what_it_lacks(view, view.box(of), skeleton.drawables[id]);
}

Cut select_cut(const FrameView& view, FrustumCulling culling) {
  Cut cut;
  cut.choice.assign(view.skeleton->scene_nodes.size(), no_id);
  std::vector<SceneNodeId> open;
  walk(view, culling, open, [&](SceneNodeId node, DrawableId choice) {
    cut.choice[node] = choice;
    if (choice != Cut::inner) cut.drawables.push_back(choice);
  });
  sort_by_rank(view, cut.drawables);
  return cut;
}

const std::vector<DrawableId>& CutLister::list(const FrameView& view, FrustumCulling culling) {
  drawables_.clear();
  walk(view, culling, open_, [&](SceneNodeId, DrawableId choice) {
    if (choice != Cut::inner) drawables_.push_back(choice);
  });
  sorter_.sort(view, drawables_);
  return drawables_;
}

}  // namespace triptych
