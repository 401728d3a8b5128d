#include "nodes/replay.hpp"

#include "base/error.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"

namespace triptych {

Replay::Replay(const Skeleton& skeleton, uint64_t pack_hash, std::string place)
    : skeleton_(skeleton), pack_hash_(pack_hash), place_(std::move(place)) {}

std::string Replay::place(uint32_t frame) const { return fmt::format("{} frame {}", place_, frame); }

void Replay::start(uint32_t frame) {
  if (current_ && current_->number == frame) return;
  const auto camera = cameras_.find(frame);
  if (camera == cameras_.end()) fail(place(frame), "its camera is not in the recording");
  current_ = camera->second;
  cameras_.erase(cameras_.begin(), std::next(camera));
  sentinel_.reset();
  stream_.emplace(skeleton_, eye_cell(skeleton_, current_->view), previous_);
}

bool Replay::matches(const VisibleSet& visible) const {
  return frame_digest(current_->number, current_->view, current_->pixel_error, pack_hash_, visible) ==
         sentinel_->digest;
}

std::optional<ReplayedFrame> Replay::finish(VisibleSet visible, bool mismatch) {
  ReplayedFrame frame{*current_, std::move(visible), mismatch};
  previous_ = frame.visible;
  current_.reset();
  stream_.reset();
  sentinel_.reset();
  return frame;
}

std::optional<ReplayedFrame> Replay::take(const Message& message) {
  if (const auto* camera = std::get_if<CameraMessage>(&message)) {
    cameras_[camera->frame] = {camera->frame, camera->view, camera->pixel_error};
  } else if (const auto* delta = std::get_if<DeltaMessage>(&message)) {
    start(delta->frame);
    VisibleDelta changes;
    try {
      changes = decode_delta(delta->encoded, previous_, place(delta->frame));
    } catch (const Error&) {
      // No change, as the render node took it; then the full set follows.
    }
    stream_->take({delta->watermark, changes});
  } else if (const auto* sentinel = std::get_if<Sentinel>(&message)) {
    start(sentinel->frame);
    sentinel_ = *sentinel;
    if (matches(stream_->visible())) return finish(stream_->visible(), false);
  } else if (const auto* full = std::get_if<FullSet>(&message)) {
    if (!current_ || !sentinel_ || current_->number != full->frame) {
      fail(place(full->frame), "a full set that nobody asked for");
    }
    if (!matches(full->visible)) fail(place(full->frame), "its visible set does not match its digest");
    return finish(full->visible, true);
  }
  return std::nullopt;
}

}  // namespace triptych
