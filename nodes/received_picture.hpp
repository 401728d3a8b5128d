// A picture whose visible set comes from elsewhere, part by part.
#pragma once

#include "base/spent_time.hpp"
#include "nodes/session_rules.hpp"
#include "nodes/streaming.hpp"
#include "visibility/motion_use.hpp"

#include <optional>
#include <span>

namespace triptych {

/// Draws one frame as its parts come, and times that. Where it has no room, it goes on without drawing, so
/// that whoever sends the parts is heard to the end.
class ReceivedPicture {
 public:
  /// streaming: null where there are no caps. All must outlive it.
  ReceivedPicture(PictureStage& picture, Streaming* streaming, const SessionRules& rules);

  void begin(const FrameView& view, uint32_t frame);
  /// More of the visible set, in draw rank order.
  void draw(std::span<const DrawableId> drawables);
  /// All of it was drawn. Tells the record what the picture lacks, and which effects ran.
  void finish(const FrameView& view, const VisibleSet& visible, FrameRecord& record);

  /// Why there is no picture; nullopt where there is one.
  const std::optional<NoRoom>& no_room() const { return no_room_; }
  const SpentTime& spent() const { return spent_; }

 private:
  template <typename Draw>
  void in_room(const Draw& draw);

  PictureStage& picture_;
  Streaming* streaming_;
  const SessionRules& rules_;
  SpentTime spent_;
  std::optional<NoRoom> no_room_;
  std::optional<MotionWatch> motion_;
};

}  // namespace triptych
