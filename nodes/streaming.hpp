// Frames whose geometry comes and goes: what is drawn where some is missing, and what records say of it.
#pragma once

#include "lod/draw_rank.hpp"
#include "nodes/frame_record.hpp"
#include "nodes/memory_keeper.hpp"
#include "nodes/pack_device.hpp"
#include "nodes/picture_stage.hpp"
#include "nodes/prefetch.hpp"
#include "nodes/substitutes.hpp"

#include <optional>
#include <vector>

namespace triptych {

/// About what pictures and depths of this size take once they are drawn.
uint64_t picture_bytes_of(const FrameState& state);

/// Sits around the frames of a device that reads ahead (PackDevice::read_ahead()), in one process and at the
/// render node of a session: begin_frame(), then begin_drawing() before its visible set is drawn, and
/// complete() after it; or refused(), and that once more. At the end drawn().
class Streaming {
 public:
  /// first: as frames are drawn. Error as MemoryKeeper's. The device must outlive it.
  Streaming(PackDevice& device, const MemoryCaps& caps, const FrameState& first,
            MemoryKeeper::NoPixelError otherwise);

  /// The pixel error to draw a frame with: the asked one, or a larger one.
  double raise(double asked) const { return keeper_.raise(asked); }
  /// Whether the frame is drawn without what has no room.
  bool leaves_out() const { return keeper_.leaves_out(); }
  /// Of a frame whose camera was sent before it was known that what it shows has no room at such an error.
  bool is_too_fine(double pixel_error) const { return leaves_out() && pixel_error < raise(pixel_error); }

  void begin_frame();
  void begin_drawing();
  /// A frame's visible set was drawn, and is not finished. Where something was missing the picture is drawn
  /// anew, with what is coarser and there. Tells the record what it lacks. NoRoom as Device.
  void complete(PictureStage& picture, const FrameView& view, const VisibleSet& visible, FrameRecord& record);
  /// What was drawn with this pixel error had no room. Error where no frame will.
  void refused(double pixel_error, const NoRoom& why) { keeper_.refused(pixel_error, why); }
  /// A frame was drawn, for which this pixel error was asked, and the record's was taken. next: where the
  /// camera goes, if that is known. Until the next frame whoever draws does without what has no room.
  void drawn(const FrameView& view, const VisibleSet& visible, double asked, FrameRecord& record,
             const View* next = nullptr);

 private:
  uint64_t count_without_room(const VisibleSet& visible) const;

  PackDevice& pack_device_;
  Device& device_;
  ReadAhead& residency_;
  MemoryKeeper keeper_;
  Prefetch prefetch_;
  std::optional<Substitutes> substitutes_;  ///< where frames do not wait for chunks
  RankSorter sorter_;
  VisibleSet shown_;
  uint64_t left_out_ = 0, no_room_ = 0;  ///< the device's, before the frame
};

/// The same for a process whose pictures nobody sees, as a switch node's: what it has not it leaves out,
/// which hides nothing then.
class OccluderStreaming {
 public:
  OccluderStreaming(PackDevice& device, const MemoryCaps& caps, const FrameState& first);

  /// wait: for what is still to be read, as before the first frame.
  void begin_frame(bool wait);
  void drawn() { keeper_.drawn(); }

 private:
  PackDevice& device_;
  MemoryKeeper keeper_;
};

}  // namespace triptych
