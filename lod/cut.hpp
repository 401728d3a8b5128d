// Cut selection: which drawables stand for the model in one view. Pure: a function of skeleton, view and
// pixel error.
#pragma once

#include "lod/draw_rank.hpp"
#include "lod/frame_view.hpp"

#include <vector>

namespace triptych {

/// Whether drawables outside the frustum belong to the selection: `on` gives the cut; `off` adds the rest of
/// the model at the detail that its distance asks for, which is what a program without any culling would
/// draw.
enum class FrustumCulling { on, off };

/// The drawables that cover what the section keeps of the view frustum, each the coarsest that keeps the
/// pixel error.
struct Cut {
  static constexpr DrawableId inner = no_id - 1;  ///< the scene node was refined: its children hold the cut

  std::vector<DrawableId> drawables;  ///< in draw rank order
  /// For each scene node: its drawable in the cut, `inner`, or no_id where the cut is above it, or it is
  /// outside the frustum or the section, or hidden.
  std::vector<DrawableId> choice;
};

/// What the cut has at a scene node that it reaches: a drawable, Cut::inner, or no_id outside the frustum,
/// and outside the section and where all of it is hidden, which no FrustumCulling brings back. An inner scene
/// node of which some is hidden or cut away is refined, whatever its error. The one rule by which
/// select_cut() and LazyCut choose.
DrawableId choose_level(const FrameView& view, SceneNodeId node, FrustumCulling culling = FrustumCulling::on);

/// Whether the drawable may stand for all of its scene node in this view, as far as what is hidden, cut away
/// or left out goes, whatever its error is.
bool may_stand_for_node(const FrameView& view, DrawableId id);

/// The whole cut at once: the reference that LazyCut must agree with. Pixel error 0 selects full detail:
/// every leaf's finest drawable.
Cut select_cut(const FrameView& view, FrustumCulling culling = FrustumCulling::on);

/// Only the drawables of a cut, without Cut::choice, into the same list each time: walks what lies in the
/// frustum, and touches nothing else.
class CutLister {
 public:
  /// In draw rank order; valid until the next call.
  const std::vector<DrawableId>& list(const FrameView& view, FrustumCulling culling = FrustumCulling::on);

 private:
  std::vector<SceneNodeId> open_;
  std::vector<DrawableId> drawables_;
  RankSorter sorter_;
};

}  // namespace triptych
