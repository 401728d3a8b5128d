// Keeps a process that draws within its caps, and raises the pixel error where a frame needs more.
#pragma once

#include "nodes/memory_caps.hpp"
#include "visibility/device.hpp"

#include <cstdint>

namespace triptych {

/// Sits around each frame: raise() before it is drawn, refused() where it had no room, drawn() after it.
class MemoryKeeper {
 public:
  /// What becomes of a frame that has no room at any pixel error, as what a section cuts has none.
  enum class NoPixelError : uint8_t {
    fails,      ///< refused() is an Error that names the least that has room
    leaves_out  ///< it is drawn at the largest, without what has no room: leaves_out() says so
  };
  /// Gives the device's geometry what the process does not need for other things. read_ahead: bytes that are
  /// held besides. picture_bytes: about what pictures and depths take once they are drawn. Error (--memory,
  /// --device-memory) where a cap leaves no room, with the least that does. The device must outlive it.
  MemoryKeeper(Device& device, const MemoryCaps& caps, uint64_t read_ahead, uint64_t picture_bytes,
               NoPixelError otherwise = NoPixelError::fails);

  /// The pixel error to draw the next frame with: the asked one, or a larger one.
  double raise(double asked) const;
  /// A frame that was drawn with this pixel error had no room: the next one is larger. Where none is large
  /// enough: NoPixelError.
  void refused(double pixel_error, const NoRoom& why);
  /// Whether the next frame is to leave out what has no room.
  bool leaves_out() const { return leaves_out_; }
  /// A frame that was drawn with this pixel error left out what had no room: the next one is larger.
  void crowded(double pixel_error);
  /// A frame was drawn, all of it or not. Lowers the pixel error again where there is room, and takes room
  /// from geometry where the process has grown; says so once where that is not enough. Whether a smaller
  /// pixel error may have room now: not where one had none in this frame.
  bool drawn(bool all = true);

 private:
  void give_to_geometry(uint64_t bytes);
  void keep_below_cap();

  Device& device_;
  MemoryCaps caps_;
  uint64_t geometry_ = no_cap;  ///< the device's cap
  NoPixelError otherwise_;
  bool leaves_out_ = false;
  uint32_t refusals_ = 0;  ///< of the current frame
  bool said_ = false;      ///< that the process takes more than its cap
  double held_ = 0;        ///< the least pixel error that frames are drawn with
};

}  // namespace triptych
