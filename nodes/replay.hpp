// Replays frames of a session from the recorded messages of its render node.
#pragma once

#include "nodes/hidden_sets.hpp"
#include "protocol/recording.hpp"
#include "scene/frame_state.hpp"
#include "visibility/visible_stream.hpp"

#include <deque>
#include <map>
#include <optional>
#include <vector>

namespace triptych {

/// A frame as the render node had it.
struct ReplayedFrame {
  FrameRequest request;
  VisibleSet visible;            ///< V(i)
  bool digest_mismatch = false;  ///< what came in packets was not V(i), and the full set was sent
  /// Drawn without switch nodes; then `visible` is the whole cut, which gives the same picture.
  bool fallback = false;
};

/// Takes the render node's messages in their order, and gives each frame as soon as its set is complete and
/// matches its digest. Messages of later frames wait, as they did in the session.
class Replay {
 public:
  /// place: the recording, for errors. pack: the one that the session had; it must outlive this.
  Replay(const Pack& pack, std::string place);

  /// The frames that this message completed. Error (place, frame) for messages that no session can have
  /// produced: a frame without its camera, a set that does not match its digest, a camera without its set of
  /// hidden objects.
  std::vector<ReplayedFrame> take(const RecordedMessage& recorded);

 private:
  void keep(const Message& message);
  void begin(const FrameRequest& frame);
  ReplayedFrame draw_fallback(const FrameRequest& frame);
  void forget_epoch();
  /// Whether that completed the current frame.
  bool feed(const Message& message);
  bool accept(const VisibleSet& visible);
  std::string place(uint32_t frame) const;

  const Skeleton& skeleton_;
  uint64_t pack_hash_;
  std::string place_;
  HiddenSets hidden_;
  std::map<uint32_t, FrameRequest> cameras_;          ///< of frames that are not complete
  std::map<uint32_t, std::deque<Message>> messages_;  ///< of frames that are not current yet
  VisibleSet previous_;                               ///< V(i−1)
  std::optional<ReplayedFrame> current_;
  std::optional<VisibleStream> stream_;  ///< of the current frame
  std::optional<Sentinel> sentinel_;     ///< of the current frame, where its full set is awaited
};

}  // namespace triptych
