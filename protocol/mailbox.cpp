#include "protocol/mailbox.hpp"

#include "base/clock.hpp"
#include "base/error.hpp"
#include "base/timeline.hpp"

#include <algorithm>
#include <array>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

/// The timeline's name for sending it; valid as long as the thread.
const char* sending_stage(const Message& message) {
  thread_local std::array<std::string, std::variant_size_v<Message>> names;
  std::string& name = names[message.index()];
  if (name.empty()) name = "send " + message_name(message);
  return name.c_str();
}

}  // namespace

PeerLost peer_lost(Role peer, const std::string& reason) {
  return {peer, role_name(peer) + " lost: " + reason};
}

Mailbox::Mailbox() : work_(context_.get_executor()) {}

Mailbox::~Mailbox() {
  for (auto& [key, link] : links_) link->close();
}

void Mailbox::add(Role peer, Channel channel, const std::shared_ptr<Connection>& connection) {
  add(peer, channel, std::make_shared<Link>(connection));
}

void Mailbox::add(Role peer, Channel channel, const std::shared_ptr<Link>& link) {
  const Key key{peer, channel};
  if (has(peer, channel)) fail(role_name(peer), "{} is connected twice", channel_name(channel));
  link->set_place(fmt::format("{}, {}", channel_name(channel), link->place()));
  links_[key] = link;
  read_next(key);
}

void Mailbox::wrap(Channel channel,
                   const std::function<std::shared_ptr<Connection>(std::shared_ptr<Connection>)>& wrapper) {
  for (auto& [key, link] : links_) {
    if (key.second == channel) link->wrap(wrapper);
  }
}

void Mailbox::read_next(Key key) {
  links_.at(key)->read(body_limit, [this, key](Link::Outcome outcome) {
    const auto* arrived = std::get_if<Link::Arrived>(&outcome);
    const bool more = arrived != nullptr && !std::holds_alternative<Bye>(arrived->message);
    if (arrived != nullptr) {
      ++queued_.messages;
      queued_.bytes += header_bytes + arrived->body_bytes;
      note_most();
    }
    queue_.push_back({key.first, key.second, std::move(outcome), steady_milliseconds()});
    if (!more) return;
    if (is_full()) {
      paused_.insert(key);
    } else {
      read_next(key);
    }
  });
}

bool Mailbox::is_full() const {
  return queued_.messages >= mailbox_limit.messages || queued_.bytes >= mailbox_limit.bytes;
}

void Mailbox::uncount(const Entry& entry) {
  const auto* arrived = std::get_if<Link::Arrived>(&entry.outcome);
  if (arrived == nullptr) return;
  --queued_.messages;
  queued_.bytes -= header_bytes + arrived->body_bytes;
}

void Mailbox::note_most() {
  max_backlog_.messages = std::max(max_backlog_.messages, queued_.messages + kept_.messages);
  max_backlog_.bytes = std::max(max_backlog_.bytes, queued_.bytes + kept_.bytes);
}

void Mailbox::note_kept(Backlog kept) {
  kept_ = kept;
  note_most();
}

bool Mailbox::waiting_from(Role peer) const {
  return std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
    return entry.peer == peer && std::holds_alternative<Link::Arrived>(entry.outcome);
  });
}

bool Mailbox::ends(const Entry& entry) {
  const auto* arrived = std::get_if<Link::Arrived>(&entry.outcome);
  return arrived == nullptr || std::holds_alternative<Bye>(arrived->message);
}

void Mailbox::drop(Role peer) {
  left_.insert(peer);
  for (auto& [key, link] : links_) {
    if (key.first == peer) link->close();
  }
}

std::optional<PeerLost> Mailbox::send(Role peer, Channel channel, const Message& message) {
  const auto found = links_.find({peer, channel});
  if (found == links_.end()) fail(role_name(peer), "{} is not connected", channel_name(channel));
  if (left_.count(peer) != 0) return std::nullopt;
  const TimelineScope scope(sending_stage(message), frame_of(message));
  const auto bytes = encode(message);
  const auto link = found->second;
  if (observe) observe({steady_milliseconds(), true, peer, channel, message});
  const std::string reason = link->write(message, bytes, send_timeout_);
  if (reason.empty()) return std::nullopt;
  // What the peer sent before it went, perhaps its Bye, may still be on its way from the kernel.
  context_.poll();
  if (waiting_from(peer)) {
    // Reported once, however much more is sent meanwhile.
    const bool told = std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
      return entry.peer == peer && std::holds_alternative<Link::Broken>(entry.outcome);
    });
    if (!told) queue_.push_back({peer, channel, Link::Broken{reason}, steady_milliseconds()});
    return std::nullopt;
  }
  drop(peer);
  return peer_lost(peer, reason);
}

std::optional<Delivery> Mailbox::receive(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  for (;;) {
    context_.poll();
    while (!queue_.empty()) {
      if (auto delivery = take_first()) return delivery;
    }
    if (Clock::now() >= deadline) return std::nullopt;
    context_.run_one_until(deadline);
  }
}

std::optional<Delivery> Mailbox::take_first() {
  Entry entry = std::move(queue_.front());
  queue_.pop_front();
  const bool gone = left_.count(entry.peer) != 0;
  auto* arrived = std::get_if<Link::Arrived>(&entry.outcome);
  if (ends(entry)) {
    // The end of one channel waits for what has arrived on the other.
    const auto goes_before = [&](const Entry& other) { return other.peer == entry.peer && !ends(other); };
    const bool bye_follows = arrived == nullptr && waiting_from(entry.peer);
    if (!gone && (bye_follows || std::any_of(queue_.begin(), queue_.end(), goes_before))) {
      queue_.push_back(std::move(entry));
      return std::nullopt;
    }
    if (arrived == nullptr) {
      if (gone) return std::nullopt;
      drop(entry.peer);
      return peer_lost(entry.peer, std::get<Link::Broken>(entry.outcome).reason);
    }
  }
  const size_t bytes = header_bytes + arrived->body_bytes;
  uncount(entry);
  if (ends(entry) && !left_.insert(entry.peer).second) return std::nullopt;
  if (!is_full()) {
    for (const Key& key : std::exchange(paused_, {})) read_next(key);
  }
  if (observe) observe({entry.came_ms, false, entry.peer, entry.channel, arrived->message});
  return Received{entry.peer, entry.channel, std::move(arrived->message), bytes};
}

bool Mailbox::forget_if_broken(Role peer, Channel channel) {
  const auto of_link = [&](const Entry& entry) { return entry.peer == peer && entry.channel == channel; };
  const bool broken = std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
    return of_link(entry) && std::holds_alternative<Link::Broken>(entry.outcome);
  });
  if (!broken) return false;
  links_.at({peer, channel})->close();
  links_.erase({peer, channel});
  std::erase_if(queue_, [&](const Entry& entry) {
    if (!of_link(entry)) return false;
    uncount(entry);
    return true;
  });
  return true;
}

std::optional<Mailbox::End> Mailbox::first_end() const {
  const auto found = std::find_if(queue_.begin(), queue_.end(), ends);
  if (found == queue_.end()) return std::nullopt;
  if (const auto* broken = std::get_if<Link::Broken>(&found->outcome)) {
    return End{found->peer, broken->reason, false};
  }
  const auto& message = std::get<Link::Arrived>(found->outcome).message;
  return End{found->peer, std::get<Bye>(message).reason, true};
}

void Mailbox::leave(const std::string& reason) {
  const Message bye = Bye{reason};
  const auto bytes = encode(bye);
  for (auto& [key, link] : links_) {
    if (left_.count(key.first) != 0) continue;
    const std::string ignored = link->write(bye, bytes, std::chrono::milliseconds(500));  // gone already
  }
  for (auto& [key, link] : links_) {
    link->close();
    left_.insert(key.first);
  }
}

LinkFigures Mailbox::figures(Role peer, Channel channel) const {
  const auto found = links_.find({peer, channel});
  return found == links_.end() ? LinkFigures{} : found->second->figures();
}

TcpFigures Mailbox::kernel_figures(Role peer, Channel channel) const {
  const auto found = links_.find({peer, channel});
  return found == links_.end() ? TcpFigures{} : found->second->kernel_figures();
}

const Hello& Mailbox::peer_hello(Role peer) const {
  const auto found = hellos_.find(peer);
  if (found == hellos_.end()) fail(role_name(peer), "is not connected");
  return found->second;
}

}  // namespace triptych
