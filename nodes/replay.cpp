#include "nodes/replay.hpp"

#include "base/error.hpp"
#include "lod/cut.hpp"
#include "protocol/delta_codec.hpp"
#include "protocol/digest.hpp"

#include <algorithm>

namespace triptych {

Replay::Replay(const Pack& pack, std::string place)
    : skeleton_(pack.skeleton()), pack_hash_(pack.content_hash()), place_(std::move(place)), hidden_(pack) {}

std::string Replay::place(uint32_t frame) const { return fmt::format("{} frame {}", place_, frame); }

void Replay::forget_epoch() {
  cameras_.clear();
  messages_.clear();
  previous_.clear();
  current_.reset();
}

ReplayedFrame Replay::draw_fallback(const FrameRequest& request) {
  forget_epoch();
  ReplayedFrame frame{request, {}, false, true};
  frame.visible = select_cut(FrameView(skeleton_, frame.request.state)).drawables;
  std::sort(frame.visible.begin(), frame.visible.end());
  return frame;
}

void Replay::keep(const Message& message) {
  const uint32_t frame = frame_of(message);
  if (cameras_.count(frame) == 0) fail(place(frame), "its camera is not in the recording");
  messages_[frame].push_back(message);
}

std::vector<ReplayedFrame> Replay::take(const RecordedMessage& recorded) {
  const Message& message = recorded.message;
  if (const auto* camera = std::get_if<CameraMessage>(&message)) {
    FrameRequest frame{camera->frame, camera->state};
    try {
      hidden_.complete(frame.state);
    } catch (const Error& error) {
      fail(place(frame.number), "{}", error.what());
    }
    if (recorded.peer == Role::render) return {draw_fallback(frame)};
    if (camera->warm_up) {
      forget_epoch();
    } else {
      cameras_[frame.number] = std::move(frame);
    }
  } else if (const auto* set = std::get_if<HiddenSet>(&message)) {
    hidden_.add(*set);
  } else if (std::holds_alternative<DeltaMessage>(message) || std::holds_alternative<Sentinel>(message) ||
             std::holds_alternative<FullSet>(message)) {
    keep(message);
  }
  std::vector<ReplayedFrame> complete;
  while (!cameras_.empty()) {
    const FrameRequest frame = cameras_.begin()->second;
    if (!current_) begin(frame);
    std::deque<Message>& waiting = messages_[frame.number];
    bool done = false;
    while (!done && !waiting.empty()) {
      done = feed(waiting.front());
      waiting.pop_front();
    }
    if (!done) break;
    previous_ = current_->visible;
    complete.push_back(std::move(*current_));
    current_.reset();
    messages_.erase(frame.number);
    cameras_.erase(frame.number);
  }
  return complete;
}

void Replay::begin(const FrameRequest& frame) {
  current_ = ReplayedFrame{frame, {}, false, false};
  sentinel_.reset();
  stream_.emplace(skeleton_, frame.state, previous_);
}

bool Replay::feed(const Message& message) {
  const std::string frame_place = place(current_->request.number);
  if (const auto* delta = std::get_if<DeltaMessage>(&message)) {
    VisibleDelta changes;
    try {
      changes = decode_delta(delta->encoded, previous_, frame_place);
    } catch (const Error&) {
      // Taken as no change, as the render node took it; the full set follows.
    }
    stream_->take({delta->watermark, changes});
    return false;
  }
  if (const auto* sentinel = std::get_if<Sentinel>(&message)) {
    sentinel_ = *sentinel;
    current_->digest_mismatch = !accept(stream_->visible());
    return !current_->digest_mismatch;
  }
  if (!sentinel_) fail(frame_place, "a full set that nobody asked for");
  if (!accept(std::get<FullSet>(message).visible))
    fail(frame_place, "its visible set does not match its digest");
  return true;
}

bool Replay::accept(const VisibleSet& visible) {
  const FrameRequest& frame = current_->request;
  current_->visible = visible;
  return frame_digest(frame.number, frame.state, pack_hash_, visible) == sentinel_->digest;
}

}  // namespace triptych
