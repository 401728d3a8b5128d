// Where a render node's frames come from, and where they go.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/inbox.hpp"
#include "nodes/local_pipeline.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// What is to be drawn. Each frame is requested once, in order, when its camera is released; nothing of it is
/// known before.
class FrameSource {
 public:
  /// Frames `first` to `count` − 1.
  struct Numbers {
    uint32_t first = 0, count = 0;
  };

  FrameSource() = default;
  virtual ~FrameSource() = default;
  FrameSource(const FrameSource&) = delete;
  FrameSource& operator=(const FrameSource&) = delete;

  virtual Numbers numbers() const = 0;
  /// The next frame, which has this number.
  virtual FrameRequest next(uint32_t number) = 0;
  /// Whether there is a next one now; may wait a moment for it if `may_wait`.
  virtual bool ready(bool /*may_wait*/) { return true; }
  /// Whether the frames end here although `count` is not reached.
  virtual bool finished() { return false; }
};

/// Is told of the end of each epoch, in any role.
class EpochSink {
 public:
  EpochSink() = default;
  virtual ~EpochSink() = default;
  EpochSink(const EpochSink&) = delete;
  EpochSink& operator=(const EpochSink&) = delete;

  /// The mailbox still has its figures. reason: what ended it; empty at the end of the session.
  virtual void epoch_ended(const Mailbox& /*mailbox*/, const std::string& /*reason*/) {}
};

/// What takes a render node's frames.
class FrameSink : public EpochSink {
 public:
  /// Called for each frame as soon as its picture is drawn: to put it on a screen.
  virtual void show(const FrameRequest& /*frame*/, const FrameRecord& /*record*/, LocalPipeline& /*stages*/) {
  }
  /// Called for each frame after show(), with its record and its picture, which is valid until this returns.
  virtual void picture(FrameRecord record, const FrameTarget& target) = 0;
  /// Called at the beginning of each epoch with both switch nodes' clocks.
  virtual void clocks(const std::vector<PeerClock>& /*clocks*/) {}
};

}  // namespace triptych
