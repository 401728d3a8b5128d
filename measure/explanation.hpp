// Explains a frame: which drawable owns a pixel, why it was chosen, and why another was not.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "visibility/occlusion_strategy.hpp"

#include <map>
#include <optional>
#include <vector>

namespace triptych {

/// A drawable as one view sees it.
struct DrawableFacts {
  DrawableId id = no_id;
  SceneNodeId scene_node = 0;
  uint32_t depth = 0;              ///< of its scene node; the root has 1
  uint32_t level = 0, levels = 1;  ///< among its scene node's drawables, 0 the finest
  uint32_t triangles = 0;
  double error = 0;   ///< δ, model units
  double pixels = 0;  ///< δ projected in this view; infinite if the eye is too near for a bound
};

/// What became of a drawable in a frame, and which stage decided it.
enum class Fate {
  drawn,
  coarser,          ///< cut selection: a coarser one that keeps the pixel error represents it
  finer,            ///< cut selection: it exceeds the pixel error, finer ones represent it
  outside_frustum,  ///< cut selection: its scene node or one above lies beyond a plane of the frustum
  between_pixels,   ///< hardware cull: its box, or one above, covers no pixel's centre
  hidden,           ///< hardware cull: behind the occlusion representation
  withheld,         ///< nothing hides it, but it is not in V(i): a fault in culling
};

struct DrawableExplanation {
  DrawableFacts facts;
  Fate fate = Fate::drawn;
  uint64_t pixels_owned = 0;
  /// The next coarser one, which cut selection tried first and found beyond the pixel error; none where there
  /// is no coarser one, and where this one is not in the cut.
  std::optional<DrawableFacts> coarser;
  bool finest_there_is = false;  ///< chosen although it exceeds the pixel error
  /// outside_frustum, between_pixels, hidden: the scene node, its own or one above, at which that was
  /// decided.
  SceneNodeId decided_at = no_id;
  /// coarser, finer: the cut's drawables that represent it. hidden: what owns pixels in the rectangle of
  /// `decided_at`. Those with most pixels first.
  std::vector<DrawableFacts> by;
  std::vector<uint64_t> by_pixels;  ///< of each of `by`, pixels owned (hidden: within the rectangle)
};

/// Draws frames as the one-process fallback does, and explains the last. device: a chosen one.
class Explainer : private TestObserver {
 public:
  Explainer(const Pack& pack, int width, int height, const DeviceOptions& device);

  /// Draw frames in order: the picture does not depend on earlier frames, but what is culled does.
  void draw(const FrameRequest& frame);

  /// The drawable at a pixel of the last frame, counted from its left and top; none where there is
  /// background. Error for a pixel outside the picture.
  std::optional<DrawableId> at(int x, int y);
  /// Error for an id that the pack does not have.
  DrawableExplanation explain(DrawableId id);

 private:
  void tested(SceneNodeId node, bool shows) override { tests_[node] = shows; }
  DrawableFacts facts_of(DrawableId id) const;
  std::optional<DrawableFacts> next_coarser(DrawableId id) const;
  void explain_cut(DrawableExplanation& explanation);
  void explain_culling(DrawableExplanation& explanation);
  void name_what_is_in_front(DrawableExplanation& explanation);
  void name_descendants(SceneNodeId node, DrawableExplanation& explanation);
  const std::vector<uint32_t>& items();

  FrameView view() const { return {skeleton_, frame_.state, pipeline_.rules()}; }

  const Skeleton& skeleton_;
  PackDevice device_;
  OcclusionStrategy strategy_;
  LocalPipeline pipeline_;
  PictureStage item_stage_;
  FrameRequest frame_;
  FrameRecord record_;
  std::map<SceneNodeId, bool> tests_;  ///< the last frame's answers
  std::vector<uint32_t> items_;        ///< of the last frame; empty until used
};

}  // namespace triptych
