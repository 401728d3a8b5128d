// A session's frames from a person at a window.
#pragma once

#include "nodes/frame_source.hpp"
#include "nodes/picture_stage.hpp"
#include "session/run_options.hpp"
#include "view/viewer.hpp"

#include <optional>

namespace triptych {

/// The options of a command's viewer: title, size, path, pixel error, what is hidden. Error for a path that
/// cannot be used, and as load_hiding().
ViewerOptions viewer_options(const RunOptions& run, const Pack& pack);

/// Gives the render node a person's cameras, which are not known before they are released, and shows its
/// pictures in a window. The window's context is current in this thread, and the render node draws in it.
class WindowSource : public FrameSource {
 public:
  /// Frames from `first` on, until the window is closed.
  WindowSource(const Pack& pack, const ViewerOptions& options, uint32_t first)
      : first_(first), viewer_(pack, options) {}

  Numbers numbers() const override;
  FrameRequest next(uint32_t number) override;
  bool ready(bool may_wait) override;
  bool finished() override { return viewer_.left(); }
  /// Shows a frame; where culling is off, the whole cut that it was culled from.
  void show(const FrameRequest& frame, const FrameRecord& record, LocalPipeline& stages);
  const DeviceNames& names() const { return viewer_.names(); }
  /// Both switch nodes are there; or they are not, for a reason that ends an epoch or kept one from
  /// beginning.
  void say_together() { viewer_.say_alone(""); }
  void say_alone(const std::string& reason);

 private:
  uint32_t first_;
  Viewer viewer_;
  std::optional<PictureStage> whole_cut_;
};

}  // namespace triptych
