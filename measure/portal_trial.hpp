// What cells and portals of a building leave of a walk through it, against the other strategies.
#pragma once

#include "nodes/local_pipeline.hpp"
#include "scene/pack.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace triptych {

/// One entry a frame, where not said otherwise.
struct PortalTrial {
  std::shared_ptr<const CellGraph> cells;
  double subdivision_seconds = 0;  ///< reading walls, and dividing space along them
  double visibility_seconds = 0;   ///< finding portals
  /// Of the triangles of full detail, without levels of detail: those that are drawn through portals.
  std::vector<double> polygons_share;
  /// At the frames' own pixel error: triangles that are drawn, those of drawables that own a pixel, and
  /// wall-clock times of whole frames, by turns.
  std::vector<double> drawn_triangles, owners_triangles, frame_ms, occlusion_ms;
};

/// options: but for the strategy. Error as Pack::read_chunk().
PortalTrial try_portals(const Pack& pack, std::span<const FrameRequest> frames, LocalPipelineOptions options);

}  // namespace triptych
