// The hardware cull (HC): which drawables of a cut show past the occlusion representation.
#pragma once

#include "lod/cut.hpp"
#include "visibility/occlusion_tester.hpp"
#include "visibility/visible_set.hpp"

#include <functional>

namespace triptych {

/// A piece of a frame's delta. Every drawable whose draw rank is below the watermark is decided.
struct CullPacket {
  DrawRank watermark;
  VisibleDelta delta;
};

struct CullOptions {
  /// Boxes a batch, at most. Where much is found that the occlusion representation lacks, what is found in
  /// front must hide what lies behind it: at most `most_found` of a batch show at once, the nearest, the
  /// others are tested again once those are drawn, and the next batch holds `least_batch`. Each batch that
  /// finds no more than that doubles the next one. A frame begins with the least where the representation
  /// holds less than half as many drawables as were visible one frame ago, or none.
  size_t batch = 512, least_batch = 8, most_found = 2;
  /// A packet is emitted once it holds so many ids that change, and at the end. Smaller packets let receivers
  /// begin earlier and cost more bytes; docs/protocol.md has figures.
  size_t packet_ids = 32;
  /// Told of each box that was tested, by its scene node, and whether it shows: for explanations.
  std::function<void(SceneNodeId, bool)> on_test = {};
};

struct CullResult {
  VisibleSet visible;
  uint64_t tests = 0;  ///< boxes tested, inner scene nodes' included
  uint64_t batches = 0;
  uint64_t hidden_subtrees = 0;  ///< inner scene nodes that were hidden at once
  uint64_t untested = 0;         ///< drawables that count as visible because their bounds are unknown
};

/// Tests the cut's drawables in draw rank order, in batches, inner scene nodes first, so that a hidden
/// subtree costs one test; scene nodes with content that was visible one frame ago are not worth their own
/// test. A drawable in pieces is tested by its placements' boxes, and again, by its pieces', if it shows; at
/// once by its pieces' if it was visible one frame ago. Of many pieces the two that are largest on the screen
/// are tested first, and all of them if neither shows. What is found visible and is not yet in the
/// representation is drawn into it between batches, a few at a time. Batches are cut by rank and count alone,
/// so the same frame gives the same answer whatever the timing (interactive-display-2003 §4.3).
///
/// tester: holds R(i), in which `represented` (drawables of the cut) was drawn under `view`.
/// previous: V(i−1); emit: called at least once, with V(i−1) → V(i) in pieces.
CullResult hardware_cull(const Skeleton& skeleton, const View& view, const Cut& cut, OcclusionTester& tester,
                         const std::vector<DrawableId>& represented, const VisibleSet& previous,
                         const CullOptions& options, const std::function<void(const CullPacket&)>& emit);

}  // namespace triptych
