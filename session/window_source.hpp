// A session's frames from a person at a window.
#pragma once

#include "nodes/render_node.hpp"
#include "session/run_options.hpp"
#include "view/viewer.hpp"

#include <optional>

namespace triptych {

/// How the viewer of a command looks: its title, size, path, pixel error. Error for a path that cannot be
/// used.
ViewerOptions viewer_options(const RunOptions& run);

/// Cameras for the render node, unknown before they are released, and its pictures in the window, where it
/// also draws: the window's context is this thread's.
class WindowSource {
 public:
  WindowSource(const Pack& pack, const ViewerOptions& options) : viewer_(pack, options) {}

  /// Frames from `first` on, as long as the person stays.
  FrameSource frames(uint32_t first);
  /// Shows a frame; where culling is off, the whole cut that it was culled from.
  void show(const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages);
  const DeviceNames& names() const { return viewer_.names(); }

 private:
  Viewer viewer_;
  std::optional<PictureStage> whole_cut_;
};

}  // namespace triptych
