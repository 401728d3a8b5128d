#include "nodes/peers.hpp"

#include "base/notice.hpp"
#include "protocol/connect.hpp"

#include <algorithm>
#include <thread>

namespace triptych {

namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

/// Uploading a large model's geometry may take its time; nobody waits for it.
constexpr auto rehearsal_limit = std::chrono::seconds(60);
constexpr auto short_epoch = std::chrono::seconds(10);
constexpr milliseconds first_pause(500), longest_pause(10'000);

}  // namespace

Peers::Peers(Connect connect, OnEnd on_end, OnClocks on_clocks)
    : connect_(std::move(connect)), on_end_(std::move(on_end)), on_clocks_(std::move(on_clocks)) {
  search(milliseconds(0));
}

Peers::~Peers() { stop_ = true; }  // the future waits for its thread

void Peers::search(milliseconds pause) {
  search_ = std::async(std::launch::async, [this, pause]() -> std::unique_ptr<Mailbox> {
    const auto stopped = [this] { return stop_.load(); };
    for (const auto until = Clock::now() + pause; Clock::now() < until && !stopped();)
      std::this_thread::sleep_for(milliseconds(20));
    return stopped() ? nullptr : connect_(stopped);
  });
}

bool Peers::look(const FrameRequest& next) {
  if (inbox_) return true;
  try {
    if (mailbox_) {
      if (!both_ready()) return false;
      inbox_.emplace(*mailbox_);
      since_ = Clock::now();
      compare_clocks();
      ++epochs_;
      return true;
    }
    if (search_.valid() && search_.wait_for(milliseconds(0)) == std::future_status::ready) {
      mailbox_ = search_.get();
      if (mailbox_) rehearse(next);
    }
  } catch (const PeerLost& lost) {
    lose(lost.what(), false);
  } catch (const Error& error) {
    if (!patient_) throw;
    notice("{}; goes on waiting", error.what());
    search(first_pause);
  }
  return false;
}

void Peers::wait(const FrameRequest& first) {
  patient_ = false;
  while (!look(first)) {
    if (stop_requested()) throw SessionEnded();
    std::this_thread::sleep_for(milliseconds(2));
  }
  patient_ = true;
}

void Peers::rehearse(const FrameRequest& frame) {
  ready_.clear();
  since_ = Clock::now();
  for (const Role peer : {Role::switch_0, Role::switch_1}) {
    mailbox_->send(peer, Channel::camera,
                   CameraMessage{frame.number, frame.state.view, frame.state.pixel_error, false, true});
  }
}

bool Peers::both_ready() {
  while (const auto received = mailbox_->receive(milliseconds(0))) {
    if (const auto* bye = std::get_if<Bye>(&received->message)) {
      throw PeerLost(received->peer, bye->reason.empty() ? "left" : "left: " + bye->reason);
    }
    if (std::holds_alternative<Ready>(received->message)) ready_.insert(received->peer);
  }
  if (ready_.size() == 2) return true;
  if (Clock::now() - since_ > rehearsal_limit) {
    const Role missing = ready_.count(Role::switch_0) ? Role::switch_1 : Role::switch_0;
    throw PeerLost(missing, fmt::format("not ready after {} s", rehearsal_limit.count()));
  }
  return false;
}

void Peers::compare_clocks() {
  constexpr milliseconds limit(2000);  // both have just said that they are ready
  inbox_->limit_waiting(limit);
  std::vector<PeerClock> clocks;
  for (const Role peer : {Role::switch_0, Role::switch_1}) {
    try {
      clocks.push_back(inbox_->clock_of(peer));
    } catch (const SessionEnded&) {
      if (stop_requested()) throw;
      throw PeerLost(peer, "a switch node left");
    }
  }
  inbox_->limit_waiting(std::nullopt);
  if (on_clocks_) on_clocks_(clocks);
}

void Peers::close(const std::string& reason) {
  inbox_.reset();
  if (!mailbox_) return;
  mailbox_->leave(reason);
  if (on_end_) on_end_(*mailbox_, reason);
  mailbox_.reset();
}

void Peers::lose(const std::string& reason, bool too_late) {
  const bool was_short = Clock::now() - since_ < short_epoch;
  too_late_ = too_late && was_short ? too_late_ + 1 : 0;
  close(reason);
  milliseconds pause(0);
  if (too_late_ > 1) pause = std::min(longest_pause, first_pause * (1 << std::min(too_late_ - 2, 5u)));
  search(pause);
}

void Peers::leave(const std::string& reason) {
  stop_ = true;
  if (!mailbox_ && search_.valid()) {
    try {
      mailbox_ = search_.get();
    } catch (const Error&) {  // whoever could not be found need not be told
    }
  }
  close(reason);
}

}  // namespace triptych
