#include "measure/portal_trial.hpp"

#include "base/clock.hpp"
#include "base/progress.hpp"
#include "cells/make_cells.hpp"
#include "cells/split_space.hpp"
#include "visibility/frame_target.hpp"

namespace triptych {

namespace {

void find_cells(const Pack& pack, PortalTrial& trial) {
  const Skeleton& skeleton = pack.skeleton();
  const Stopwatch clock;
  const Walls walls = find_walls(pack);
  CellGraph graph = split_space(walls, skeleton.lattice().box(skeleton.scene_nodes[0].box));
  trial.subdivision_seconds = clock.seconds();
  add_portals(walls, graph);
  trial.visibility_seconds = clock.seconds() - trial.subdivision_seconds;
  trial.cells = std::make_shared<const CellGraph>(std::move(graph));
}

double triangles_of(const Skeleton& skeleton, const VisibleSet& drawables) {
  uint64_t triangles = 0;
  for (const DrawableId id : drawables) triangles += skeleton.drawables[id].triangles;
  return static_cast<double>(triangles);
}

}  // namespace

PortalTrial try_portals(const Pack& pack, std::span<const FrameRequest> frames,
                        LocalPipelineOptions options) {
  PortalTrial trial;
  find_cells(pack, trial);
  options.cull = StrategyKind::portals;
  options.cells = trial.cells;
  LocalPipeline portals(pack, options), at_full_detail(pack, options);
  options.cull = StrategyKind::occlusion;
  LocalPipeline occlusion(pack, options);
  options.item_buffer = true;
  LocalPipeline items(pack, options);
  const double all = static_cast<double>(pack.skeleton().placed_triangles);

  Progress progress("measure building", 2 * frames.size());
  for (const bool warm : {false, true}) {
    for (const FrameRequest& frame : frames) {
      const FrameRecord through = portals.draw(frame);
      const FrameRecord tested = occlusion.draw(frame);
      progress.advance();
      if (!warm) continue;
      trial.frame_ms.push_back(through.frame_ms);
      trial.occlusion_ms.push_back(tested.frame_ms);
      trial.drawn_triangles.push_back(static_cast<double>(through.drawn_triangles));
      items.draw(frame);
      trial.owners_triangles.push_back(
          triangles_of(pack.skeleton(), owners(items.target(), frame.state.samples)));
      FrameRequest fine = frame;
      fine.state.pixel_error = 0;
      const FrameRecord whole = at_full_detail.draw(fine);
      trial.polygons_share.push_back(all > 0 ? static_cast<double>(whole.drawn_triangles) / all : 0);
    }
  }
  return trial;
}

}  // namespace triptych
