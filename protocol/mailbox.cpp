#include "protocol/mailbox.hpp"

#include "base/inject.hpp"

#include <algorithm>

namespace triptych {

namespace {

using Clock = std::chrono::steady_clock;

/// A role that does not keep up lets its peers wait rather than its memory grow.
constexpr size_t queue_limit = size_t{2} * body_limit;

void flip_a_byte_of_the_body(std::vector<std::byte>& bytes) {
  if (bytes.size() > header_bytes) bytes[(header_bytes + bytes.size()) / 2] ^= std::byte{0x10};
}

}  // namespace

Mailbox::Mailbox() : work_(context_.get_executor()) {}

Mailbox::~Mailbox() {
  for (auto& [key, link] : links_) link->close();
}

void Mailbox::add(Role peer, Channel channel, asio::ip::tcp::socket socket) {
  asio::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  const std::string where =
      error ? error.message() : fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
  add(peer, channel, std::make_shared<Link>(std::move(socket), where));
}

void Mailbox::add(Role peer, Channel channel, std::shared_ptr<Link> link) {
  const Key key{peer, channel};
  if (has(peer, channel)) fail(role_name(peer), "{} is connected twice", channel_name(channel));
  link->set_place(fmt::format("{}, {}", channel_name(channel), link->place()));
  links_[key] = std::move(link);
  read_next(key);
}

void Mailbox::read_next(Key key) {
  links_.at(key)->read(body_limit, [this, key](Link::Outcome outcome) {
    const auto* arrived = std::get_if<Link::Arrived>(&outcome);
    const bool more = arrived != nullptr && !std::holds_alternative<Bye>(arrived->message);
    if (arrived != nullptr) queued_bytes_ += arrived->body_bytes;
    queue_.push_back({key.first, key.second, std::move(outcome)});
    if (!more) return;
    if (queued_bytes_ < queue_limit) {
      read_next(key);
    } else {
      paused_.insert(key);
    }
  });
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

void Mailbox::send(Role peer, Channel channel, const Message& message) {
  const auto found = links_.find({peer, channel});
  if (found == links_.end()) fail(role_name(peer), "{} is not connected", channel_name(channel));
  if (left_.count(peer) != 0) return;
  auto bytes = encode(message);
  if (channel == Channel::nodes && ++nodes_messages_ % 50 == 0 && injected(Fault::flipped_byte)) {
    flip_a_byte_of_the_body(bytes);
  }
  const auto link = found->second;
  const std::string reason = link->write(message, bytes, send_timeout_);
  if (reason.empty()) return;
  // What the peer sent before it went, perhaps its Bye, may still be on its way from the kernel.
  context_.poll();
  if (waiting_from(peer)) {
    queue_.push_back({peer, channel, Link::Broken{reason, false}});
    return;
  }
  drop(peer);
  throw PeerLost(peer, reason);
}

std::optional<Received> Mailbox::receive(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  for (;;) {
    context_.poll();
    while (!queue_.empty()) {
      if (auto received = take_first()) return received;
    }
    if (Clock::now() >= deadline) return std::nullopt;
    context_.run_one_until(deadline);
  }
}

std::optional<Received> Mailbox::take_first() {
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
      throw PeerLost(entry.peer, std::get<Link::Broken>(entry.outcome).reason);
    }
    if (!left_.insert(entry.peer).second) return std::nullopt;
  }
  queued_bytes_ -= arrived->body_bytes;
  if (queued_bytes_ < queue_limit) {
    for (const Key& key : std::exchange(paused_, {})) read_next(key);
  }
  return Received{entry.peer, entry.channel, std::move(arrived->message)};
}

bool Mailbox::forget_if_broken(Role peer) {
  const bool broken = std::any_of(queue_.begin(), queue_.end(), [&](const Entry& entry) {
    return entry.peer == peer && std::holds_alternative<Link::Broken>(entry.outcome);
  });
  if (!broken) return false;
  for (const Channel channel : all_channels) {
    const auto found = links_.find({peer, channel});
    if (found == links_.end()) continue;
    found->second->close();
    links_.erase(found);
  }
  std::erase_if(queue_, [&](const Entry& entry) { return entry.peer == peer; });
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
    if (left_.count(key.first) == 0) link->write(bye, bytes, std::chrono::milliseconds(500));
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

const Hello& Mailbox::peer_hello(Role peer) const {
  const auto found = hellos_.find(peer);
  if (found == hellos_.end()) fail(role_name(peer), "is not connected");
  return found->second;
}

}  // namespace triptych
