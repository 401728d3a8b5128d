// Messages between two mailboxes over loopback, and every way in which a peer can go.
#include "protocol/mailbox.hpp"

#include "base/error.hpp"
#include "protocol/flipping_connection.hpp"
#include "protocol/tcp_connection.hpp"
#include "tests/protocol/sample_messages.hpp"

#include <asio/connect.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/write.hpp>
#include <gtest/gtest.h>
#include <thread>

namespace triptych {
namespace {

using asio::ip::tcp;
using namespace std::chrono_literals;

/// Two connected sockets, each in its own io_context, that hold little of what was sent and not taken.
std::pair<tcp::socket, tcp::socket> connected_pair(asio::io_context& one, asio::io_context& other) {
  const asio::socket_base::send_buffer_size send_buffer(16'384);
  const asio::socket_base::receive_buffer_size receive_buffer(16'384);
  tcp::acceptor acceptor(one, tcp::endpoint(asio::ip::address_v4::loopback(), 0));
  acceptor.set_option(send_buffer);
  acceptor.set_option(receive_buffer);
  tcp::socket caller(other, tcp::v4());
  caller.set_option(send_buffer);
  caller.set_option(receive_buffer);
  caller.connect(acceptor.local_endpoint());
  return {acceptor.accept(), std::move(caller)};
}

std::optional<Received> received_by(Mailbox& mailbox, std::chrono::milliseconds timeout = 5s) {
  const auto delivery = mailbox.receive(timeout);
  const auto* received = delivery ? std::get_if<Received>(&*delivery) : nullptr;
  return received ? std::optional(*received) : std::nullopt;
}

/// The loss that comes next; fails the test where it is none.
PeerLost loss_of(Mailbox& mailbox) {
  const auto delivery = mailbox.receive(5s);
  const auto* lost = delivery ? std::get_if<PeerLost>(&*delivery) : nullptr;
  EXPECT_NE(lost, nullptr) << "no peer was lost";
  return lost ? *lost : PeerLost{};
}

/// The render node's mailbox and switch node 0's, connected on both channels.
class MailboxPair : public testing::Test {
 protected:
  MailboxPair() {
    for (const Channel channel : all_channels) {
      auto [one, other] = connected_pair(render.context(), switch_0->context());
      render.add(Role::switch_0, channel, tcp_connection(std::move(one)));
      switch_0->add(Role::render, channel, tcp_connection(std::move(other)));
    }
  }

  /// From the switch node to the render node.
  void say(const Message& message, Channel channel = Channel::nodes) const {
    EXPECT_FALSE(switch_0->send(Role::render, channel, message));
  }
  /// The render node's next message; fails the test where there is none.
  Message next() {
    const auto received = received_by(render);
    EXPECT_TRUE(received.has_value());
    return received ? received->message : Message(Bye{"nothing came"});
  }

  Mailbox render;
  std::unique_ptr<Mailbox> switch_0 = std::make_unique<Mailbox>();
};

TEST_F(MailboxPair, messages_arrive_in_order_with_their_sender_and_channel) {
  const auto messages = sample_messages();
  for (const Message& message : messages) {
    if (!std::holds_alternative<Bye>(message)) say(message);
  }
  for (const Message& message : messages) {
    if (std::holds_alternative<Bye>(message)) continue;
    const auto received = received_by(render);
    ASSERT_TRUE(received.has_value());
    EXPECT_EQ(received->peer, Role::switch_0);
    EXPECT_EQ(received->channel, Channel::nodes);
    EXPECT_TRUE(received->message == message);
  }
  EXPECT_FALSE(render.receive(0ms).has_value());
}

TEST_F(MailboxPair, a_silent_peer_lets_receive_time_out) {
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(render.receive(60ms).has_value());
  const auto waited = std::chrono::steady_clock::now() - start;
  EXPECT_GE(waited, 60ms);
  EXPECT_LT(waited, 2s);
}

TEST_F(MailboxPair, what_was_sent_is_what_was_received_in_the_figures) {
  const Message delta = DeltaMessage{1, {5, 5}, encode_delta({{1, 2, 3}, {9}}, {9})};
  say(delta);
  say(FullSetRequest{1}, Channel::camera);
  next();
  next();
  const LinkFigures sent = switch_0->figures(Role::render, Channel::nodes);
  const LinkFigures received = render.figures(Role::switch_0, Channel::nodes);
  EXPECT_EQ(sent.messages_sent, 1u);
  EXPECT_EQ(sent.bytes_sent, encode(delta).size());
  EXPECT_EQ(sent.delta_body_bytes_sent, encode(delta).size() - header_bytes);
  EXPECT_EQ(sent.delta_ids_sent, 4u);
  EXPECT_EQ(sent.wire_bytes_sent, encode(delta).size() + 66);
  EXPECT_EQ(received.bytes_received, sent.bytes_sent);
  EXPECT_EQ(received.delta_ids_received, 4u);
  EXPECT_EQ(render.figures(Role::switch_0, Channel::camera).bytes_received, header_bytes);
  EXPECT_EQ(render.figures(Role::switch_1, Channel::camera).messages_sent, 0u);
}

TEST_F(MailboxPair, large_messages_both_ways_at_once_do_not_block) {
  FullSet large{1, {}};
  for (DrawableId id = 0; large.visible.size() < 200'000; id += 3 + id % 977) large.visible.push_back(id);
  const auto exchange = [&](Mailbox& mailbox, Role peer) {
    if (mailbox.send(peer, Channel::nodes, large)) return false;
    const auto received = received_by(mailbox, 20s);
    return received && received->message == Message(large);
  };
  bool other_got_it = false;
  std::thread other([&] { other_got_it = exchange(*switch_0, Role::render); });
  EXPECT_TRUE(exchange(render, Role::switch_0));
  other.join();
  EXPECT_TRUE(other_got_it);
}

TEST_F(MailboxPair, a_killed_peer_is_lost_after_what_it_had_sent) {
  say(FullSetRequest{7});
  say(FullSetRequest{8}, Channel::camera);
  switch_0.reset();
  std::set<uint32_t> frames = {frame_of(next()), frame_of(next())};
  EXPECT_EQ(frames, (std::set<uint32_t>{7, 8}));
  const PeerLost lost = loss_of(render);
  EXPECT_EQ(lost.peer, Role::switch_0);
  EXPECT_NE(lost.reason.find("switch node 0 lost: "), std::string::npos) << lost.reason;
  EXPECT_NE(lost.reason.find("closed by the peer"), std::string::npos) << lost.reason;
  EXPECT_FALSE(render.receive(20ms).has_value()) << "a loss is reported once";
}

TEST_F(MailboxPair, sending_to_a_killed_peer_ends_in_its_loss) {
  switch_0.reset();
  std::optional<PeerLost> lost;
  for (int i = 0; i < 100 && !lost; ++i) {
    lost = render.send(Role::switch_0, Channel::camera, FullSetRequest{1});
    std::this_thread::sleep_for(1ms);
  }
  ASSERT_TRUE(lost.has_value());
  EXPECT_EQ(lost->peer, Role::switch_0);
}

TEST_F(MailboxPair, a_bye_is_delivered_once_and_what_follows_is_no_error) {
  say(FullSetRequest{7});
  switch_0->leave("the model is gone");
  switch_0.reset();
  EXPECT_EQ(frame_of(next()), 7u);
  const Message bye = next();
  ASSERT_TRUE(std::holds_alternative<Bye>(bye));
  EXPECT_EQ(std::get<Bye>(bye).reason, "the model is gone");
  EXPECT_FALSE(render.receive(20ms).has_value());
  EXPECT_FALSE(render.send(Role::switch_0, Channel::camera, FullSetRequest{1}));
}

TEST_F(MailboxPair, a_bye_that_waits_to_be_received_goes_before_the_failure_to_send) {
  switch_0->leave("");
  switch_0.reset();
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(render.send(Role::switch_0, Channel::camera, FullSetRequest{1}));
    std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(std::holds_alternative<Bye>(next()));
  EXPECT_FALSE(render.receive(20ms).has_value());
}

TEST_F(MailboxPair, a_peer_that_takes_nothing_is_lost_after_the_send_timeout) {
  render.set_send_timeout(100ms);
  FullSet large{1, {}};
  for (DrawableId id = 0; large.visible.size() < 200'000; id += 3 + id % 977) large.visible.push_back(id);
  std::optional<PeerLost> lost;
  for (int i = 0; i < 20 && !lost; ++i) lost = render.send(Role::switch_0, Channel::nodes, large);
  ASSERT_TRUE(lost.has_value()) << "everything was taken";
  EXPECT_NE(lost->reason.find("does not take what is sent to it, for 100 ms"), std::string::npos)
      << lost->reason;
}

/// Sends until the peer takes no more.
void flood(Mailbox& mailbox, const Message& message) {
  while (!mailbox.first_end() && !mailbox.send(Role::render, Channel::nodes, message)) {
  }
}

/// Receives without taking anything, as a role does that waits to send, until the mailbox is full; and
/// longer.
void receive_till_full(Mailbox& mailbox) {
  const auto full = [&] {
    const Backlog most = mailbox.max_backlog();
    return most.messages >= mailbox_limit.messages || most.bytes >= mailbox_limit.bytes;
  };
  for (int tries = 0; tries < 2400 && !full(); ++tries) mailbox.context().run_for(50ms);
  EXPECT_TRUE(full()) << "nothing was flooded";
  mailbox.context().run_for(300ms);
}

TEST_F(MailboxPair, a_flood_of_empty_messages_waits_with_its_sender) {
  std::thread sender([&] { flood(*switch_0, FullSetRequest{1}); });
  receive_till_full(render);
  EXPECT_EQ(render.max_backlog().messages, mailbox_limit.messages);
  EXPECT_EQ(render.max_backlog().bytes, mailbox_limit.messages * header_bytes);
  // It goes on where there is room again.
  for (uint64_t taken = 0; taken < mailbox_limit.messages + 10; ++taken) next();
  render.leave("");
  sender.join();
}

TEST_F(MailboxPair, a_flood_of_large_messages_waits_with_its_sender) {
  const DeltaMessage large{1, {5, 5}, std::vector<std::byte>(size_t{30} << 20)};
  const size_t size = encode(large).size();
  std::thread sender([&] { flood(*switch_0, large); });
  receive_till_full(render);
  EXPECT_LE(render.max_backlog().bytes, mailbox_limit.bytes + size)
      << "the message that passes the limit is the last";
  next();
  render.leave("");
  sender.join();
}

TEST_F(MailboxPair, what_a_receiver_keeps_counts_as_waiting) {
  render.note_kept({3, 500});
  say(FullSetRequest{1});
  next();
  EXPECT_EQ(render.max_backlog().messages, 4u);
  EXPECT_EQ(render.max_backlog().bytes, 500 + header_bytes);
}

TEST_F(MailboxPair, a_flipped_byte_on_the_way_is_noticed) {
  switch_0->wrap(Channel::nodes, [](std::shared_ptr<Connection> connection) {
    return flipping_connection(std::move(connection));
  });
  for (uint32_t i = 0; i < 50; ++i) say(DeltaMessage{i, {1, 1}, encode_delta({{1, 2}, {3}}, {3})});
  for (uint32_t i = 0; i < 49; ++i) EXPECT_EQ(frame_of(next()), i);
  const PeerLost lost = loss_of(render);
  EXPECT_NE(lost.reason.find("frame 49: a message with a wrong checksum"), std::string::npos) << lost.reason;
}

TEST(Mailbox, garbage_and_half_messages_lose_the_peer_with_the_reason) {
  const auto whole = encode(FullSet{3, {1, 2, 3}});
  const std::string noise = "GET / HTTP/1.1\r\nHost: render\r\n\r\n";
  const std::vector<std::pair<std::vector<std::byte>, std::string>> cases = {
      {{reinterpret_cast<const std::byte*>(noise.data()),
        reinterpret_cast<const std::byte*>(noise.data()) + noise.size()},
       "does not speak this protocol"},
      {{whole.begin(), whole.end() - 1}, "closed by the peer after frame 3: "},
      {{whole.begin(), whole.begin() + 7}, "closed by the peer"},
  };
  for (const auto& [bytes, reason] : cases) {
    asio::io_context foreign;
    Mailbox mailbox;
    auto [one, other] = connected_pair(mailbox.context(), foreign);
    mailbox.add(Role::switch_1, Channel::nodes, tcp_connection(std::move(one)));
    asio::write(other, asio::buffer(bytes));
    other.close();
    const PeerLost lost = loss_of(mailbox);
    EXPECT_EQ(lost.peer, Role::switch_1);
    EXPECT_NE(lost.reason.find(reason), std::string::npos) << lost.reason;
    EXPECT_NE(lost.reason.find("nodes channel, 127.0.0.1:"), std::string::npos) << lost.reason;
  }
}

TEST(Mailbox, a_link_that_never_was_is_an_error_to_send_to) {
  Mailbox mailbox;
  EXPECT_THROW(static_cast<void>(mailbox.send(Role::render, Channel::nodes, Bye{})), Error);
  EXPECT_THROW(mailbox.peer_hello(Role::render), Error);
}

}  // namespace
}  // namespace triptych
