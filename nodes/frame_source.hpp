// Where a render node's frames come from, and where they go.
#pragma once

#include "nodes/frame_record.hpp"
#include "nodes/inbox.hpp"
#include "nodes/local_pipeline.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace triptych {

/// What is to be drawn. A frame is asked for when its camera is released, once each and in order, and nobody
/// knows it before.
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
  /// Whether there is a next one now; may wait a moment for it where `may_wait`.
  virtual bool ready(bool /*may_wait*/) { return true; }
  /// Whether no further one will come although `count` is not reached.
  virtual bool finished() { return false; }
};

/// What hears of the end of each epoch, whichever role it is.
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
  /// Each frame as soon as its picture stands in stages.target(): to show it to somebody.
  virtual void show(const FrameRequest& /*frame*/, const FrameRecord& /*record*/, LocalPipeline& /*stages*/) {
  }
  /// Each frame after that, with its record and its picture, which stays until this returns.
  virtual void picture(FrameRecord record, const FrameTarget& target) = 0;
  /// Both switch nodes' clocks, at the beginning of each epoch.
  virtual void clocks(const std::vector<PeerClock>& /*clocks*/) {}
};

}  // namespace triptych
