#include "nodes/peers.hpp"

#include "base/notice.hpp"
#include "base/thread_name.hpp"
#include "scene/hidden_objects.hpp"

#include <algorithm>
#include <system_error>
#include <thread>

namespace triptych {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// Uploading a large model's geometry may take long; meanwhile the render node draws by itself.
constexpr milliseconds least_warm_up_limit(60'000);
constexpr int warm_up_frames = 8;
constexpr auto short_epoch = std::chrono::seconds(10);
constexpr milliseconds first_pause(500), max_pause(1000), max_pause_for_late(10'000);

}  // namespace

Peers::Peers(Connect connect, FrameSink& sink, std::function<bool()> stop)
    : connect_(std::move(connect)), sink_(sink), stop_(std::move(stop)) {
  search(milliseconds(0));
}

Peers::~Peers() { leaving_ = true; }  // the future's destructor waits for its thread

void Peers::search(milliseconds pause) {
  try {
    search_ = std::async(std::launch::async, [this, pause] { return find(pause); });
  } catch (const std::system_error& error) {  // take_up_search() tries again
    notice_once(fmt::format("render node: no thread to look for switch nodes: {}", error.what()));
    since_ = Clock::now();
  }
}

std::unique_ptr<Mailbox> Peers::find(milliseconds pause) const {
  name_thread("find-peers");
  const auto stopped = [this] { return leaving_.load(); };
  for (std::string told;; pause = first_pause) {
    for (const auto until = Clock::now() + pause; Clock::now() < until && !stopped();)
      std::this_thread::sleep_for(milliseconds(20));
    if (stopped()) return nullptr;
    try {
      if (auto mailbox = connect_(stopped)) return mailbox;
    } catch (const std::exception& error) {
      if (told != error.what()) notice("{}; the render node draws alone until they come", error.what());
      told = error.what();
    }
  }
}

Awaited<bool> Peers::look(const FrameRequest& next) {
  if (inbox_) return true;
  std::optional<Ending> failure;
  if (!mailbox_) {
    failure = take_up_search(next);
  } else {
    const Awaited<bool> ready = both_ready();
    if (ready && *ready) {
      inbox_.emplace(*mailbox_, nullptr, stop_);
      since_ = Clock::now();
      failure = compare_clocks();
    } else if (!ready) {
      failure = ready.ending();
    }
  }
  if (failure) {
    lose(failure->reason, failure->too_late);
    return std::move(*failure);
  }
  if (!inbox_) return false;
  ++epochs_;
  return true;
}

std::optional<Ending> Peers::take_up_search(const FrameRequest& next) {
  if (!search_.valid()) {
    if (Clock::now() - since_ > max_pause) search(milliseconds(0));
    return std::nullopt;
  }
  if (search_.wait_for(milliseconds(0)) != std::future_status::ready) return std::nullopt;
  mailbox_ = search_.get();
  return mailbox_ ? warm_up(next) : std::nullopt;
}

std::optional<Ending> Peers::warm_up(const FrameRequest& frame) {
  ready_.clear();
  sent_ = {};
  since_ = Clock::now();
  return send({frame.number, frame.state, false, true});
}

std::optional<Ending> Peers::send(const CameraMessage& camera) {
  const Hiding& hiding = camera.state.hiding;
  std::vector<Message> messages = {camera};
  if (hiding.objects && hiding.name != sent_) {
    messages.insert(messages.begin(), HiddenSet{camera.frame, hiding.objects->objects()});
    sent_ = hiding.name;
  }
  for (const Role peer : {Role::switch_0, Role::switch_1}) {
    for (const Message& message : messages) {
      if (auto lost = mailbox_->send(peer, Channel::camera, message)) return ending_of(std::move(*lost));
    }
  }
  return std::nullopt;
}

Awaited<bool> Peers::both_ready() {
  while (auto delivery = mailbox_->receive(milliseconds(0))) {
    if (auto* lost = std::get_if<PeerLost>(&*delivery)) return ending_of(std::move(*lost));
    const auto& received = std::get<Received>(*delivery);
    if (const auto* bye = std::get_if<Bye>(&received.message))
      return ending_of_lost(received.peer, bye->reason.empty() ? "left" : "left: " + bye->reason);
    if (std::holds_alternative<Ready>(received.message)) ready_.insert(received.peer);
  }
  if (ready_.size() == 2) return true;
  if (const auto limit = std::max(least_warm_up_limit, warm_up_frames * frame_limit_);
      Clock::now() - since_ > limit) {
    const Role missing = ready_.count(Role::switch_0) ? Role::switch_1 : Role::switch_0;
    return ending_of_lost(
        missing, fmt::format("not ready after {:.0f} s", std::chrono::duration<double>(limit).count()));
  }
  return false;
}

std::optional<Ending> Peers::compare_clocks() {
  constexpr milliseconds limit(2000);  // both have just said that they are ready
  inbox_->limit_waiting(limit);
  std::vector<PeerClock> clocks;
  for (const Role peer : {Role::switch_0, Role::switch_1}) {
    const auto clock = inbox_->clock_of(peer);
    if (!clock) {
      // A switch node cannot end the session.
      return clock.ending().cause == Ending::Cause::session_over ? ending_of_lost(peer, "a switch node left")
                                                                 : clock.ending();
    }
    clocks.push_back(*clock);
  }
  inbox_->limit_waiting(std::nullopt);
  sink_.clocks(clocks);
  return std::nullopt;
}

void Peers::close(const std::string& reason) {
  inbox_.reset();
  if (!mailbox_) return;
  mailbox_->leave(reason);
  sink_.epoch_ended(*mailbox_, reason);
  mailbox_.reset();
}

void Peers::lose(const std::string& reason, bool too_late) {
  const bool was_short = Clock::now() - since_ < short_epoch;
  short_epochs_ = was_short ? short_epochs_ + 1 : 0;
  close(reason);
  milliseconds pause(0);
  if (short_epochs_ > 1) {
    pause = std::min(too_late ? max_pause_for_late : max_pause,
                     first_pause * (1 << std::min(short_epochs_ - 2, 5u)));
  }
  search(pause);
}

void Peers::leave(const std::string& reason) {
  leaving_ = true;
  if (!mailbox_ && search_.valid()) mailbox_ = search_.get();
  close(reason);
}

}  // namespace triptych
