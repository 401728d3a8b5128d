// Frames of a session again, from the messages of its render node alone.
#pragma once

#include "nodes/occlusion_stage.hpp"
#include "protocol/recording.hpp"
#include "visibility/visible_stream.hpp"

#include <map>
#include <optional>

namespace triptych {

/// A frame as the render node had it.
struct ReplayedFrame {
  FrameRequest request;
  VisibleSet visible;            ///< V(i)
  bool digest_mismatch = false;  ///< what came in packets was not V(i); it was sent again whole
};

/// Takes the render node's messages in their order, and gives each frame as soon as its set is complete and
/// matches its digest.
class Replay {
 public:
  /// place: the recording, for errors. pack_hash: of the pack that the session had.
  Replay(const Skeleton& skeleton, uint64_t pack_hash, std::string place);

  /// The frame that this message completed, if it did. Error (place, frame) for messages that no session can
  /// have had: a frame without its camera, a set that matches no digest.
  std::optional<ReplayedFrame> take(const Message& message);

 private:
  void start(uint32_t frame);
  std::optional<ReplayedFrame> finish(VisibleSet visible, bool mismatch);
  bool matches(const VisibleSet& visible) const;
  std::string place(uint32_t frame) const;

  const Skeleton& skeleton_;
  uint64_t pack_hash_;
  std::string place_;
  std::map<uint32_t, FrameRequest> cameras_;  ///< sent, their frames not complete
  VisibleSet previous_;                       ///< V(i−1)
  std::optional<FrameRequest> current_;
  std::optional<VisibleStream> stream_;  ///< of the current frame
  std::optional<Sentinel> sentinel_;     ///< of the current frame, where its full set is awaited
};

}  // namespace triptych
