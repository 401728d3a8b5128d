// Keeps a process that draws within its caps, and raises the pixel error where a frame needs more.
#pragma once

#include "nodes/memory_caps.hpp"
#include "visibility/device.hpp"

#include <cstdint>

namespace triptych {

/// Sits around each frame: raise() before it is drawn, refused() where it had no room, drawn() after it.
class MemoryKeeper {
 public:
  /// Gives the device's geometry what the process does not need for other things. read_ahead: bytes that are
  /// held besides. picture_bytes: about what pictures and depths take once they are drawn. Error (--memory,
  /// --device-memory) where a cap leaves no room, with the least that does. The device must outlive it.
  MemoryKeeper(Device& device, const MemoryCaps& caps, uint64_t read_ahead, uint64_t picture_bytes);

  /// The pixel error to draw the next frame with: the asked one, or a larger one.
  double raise(double asked) const;
  /// A frame that was drawn with this pixel error had no room: the next one is larger. Error where none is
  /// large enough.
  void refused(double pixel_error, const NoRoom& why);
  /// A frame that was drawn with this pixel error left out what had no room: the next one is larger.
  void crowded(double pixel_error);
  /// A frame was drawn. Lowers the pixel error again where there is room, and takes room from geometry where
  /// the process has grown; says so once where that is not enough.
  void drawn();

 private:
  void give_to_geometry(uint64_t bytes);

  Device& device_;
  MemoryCaps caps_;
  uint64_t geometry_ = no_cap;  ///< the device's cap
  bool said_ = false;           ///< that the process takes more than its cap
  double held_ = 0;             ///< the least pixel error that frames are drawn with
};

}  // namespace triptych
