// Three roles find each other over loopback, whatever else calls, and differences end in one clear line on
// both sides.
#include "protocol/connect.hpp"

#include "base/error.hpp"
#include "tests/protocol/sample_messages.hpp"

#include <asio/connect.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/read.hpp>
#include <asio/write.hpp>
#include <atomic>
#include <future>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace triptych {
namespace {

using asio::ip::tcp;
using namespace std::chrono_literals;

/// A mailbox, or what is wrong.
struct Connected {
  std::unique_ptr<Mailbox> mailbox;
  std::string error;
};

std::optional<Received> received_by(Mailbox& mailbox) {
  const auto delivery = mailbox.receive(5s);
  const auto* received = delivery ? std::get_if<Received>(&*delivery) : nullptr;
  return received ? std::optional(*received) : std::nullopt;
}

/// The three roles of a session on this machine, each to be connected in a thread of its own.
class Session : public testing::Test {
 protected:
  std::future<Connected> start(Hello own, std::chrono::milliseconds timeout = 10s) {
    auto own_key = key;
    return std::async(std::launch::async, [this, own = std::move(own), timeout, own_key] {
      const Listener* listener = own.role == Role::render     ? &render_port
                                 : own.role == Role::switch_0 ? &switch_port
                                                              : nullptr;
      ConnectOutcome outcome =
          connect_session(own, listener, addresses, timeout, {}, own_key ? &*own_key : nullptr);
      if (outcome.place.empty()) return Connected{std::move(outcome.mailbox), ""};
      return Connected{nullptr, outcome.place + ": " + outcome.what};
    });
  }
  std::future<Connected> start(Role role, std::chrono::milliseconds timeout = 10s) {
    return start(sample_hello(role), timeout);
  }
  /// A socket of somebody who is no role.
  tcp::socket stranger() {
    tcp::socket socket(strangers);
    socket.connect({asio::ip::address_v4::loopback(), render_port.port()});
    return socket;
  }
  void say(tcp::socket& socket, const Message& message) {
    asio::write(socket, asio::buffer(encode(message)));
  }
  static void expect_all(std::future<Connected>& render, std::future<Connected>& switch_0,
                         std::future<Connected>& switch_1) {
    // Kept until all are connected: a role that goes before the others are complete is an error to them.
    const std::array connected = {render.get(), switch_0.get(), switch_1.get()};
    for (const Connected& role : connected) EXPECT_EQ(role.error, "");
  }

  std::optional<SharedKey> key;  ///< of roles that are started from now on
  asio::io_context strangers;
  Listener render_port{Address{"127.0.0.1", 0}};
  Listener switch_port{Address{"127.0.0.1", 0}};
  std::map<Role, Address> addresses = {{Role::render, render_port.address()},
                                       {Role::switch_0, switch_port.address()}};
};

TEST_F(Session, every_pair_of_roles_gets_two_sockets) {
  auto futures = std::array{start(Role::switch_1), start(Role::switch_0), start(Role::render)};
  std::map<Role, std::unique_ptr<Mailbox>> mailboxes;
  for (const auto& [future, role] :
       {std::pair{&futures[0], Role::switch_1}, {&futures[1], Role::switch_0}, {&futures[2], Role::render}}) {
    Connected connected = future->get();
    ASSERT_EQ(connected.error, "");
    mailboxes[role] = std::move(connected.mailbox);
  }
  uint32_t frame = 0;
  for (const Role from : all_roles) {
    for (const Role to : all_roles) {
      if (from == to) continue;
      EXPECT_EQ(mailboxes[from]->peer_hello(to).device.renderer, sample_hello(to).device.renderer);
      EXPECT_EQ(mailboxes[from]->peer_hello(to).role, to);
      for (const Channel channel : all_channels) {
        ASSERT_FALSE(mailboxes[from]->send(to, channel, FullSetRequest{++frame}));
        const auto received = received_by(*mailboxes[to]);
        ASSERT_TRUE(received.has_value());
        EXPECT_EQ(received->peer, from);
        EXPECT_EQ(received->channel, channel);
        EXPECT_EQ(frame_of(received->message), frame);
      }
    }
  }
}

TEST_F(Session, roles_may_come_in_any_order) {
  auto switch_1 = start(Role::switch_1);
  std::this_thread::sleep_for(150ms);
  auto render = start(Role::render);
  std::this_thread::sleep_for(150ms);
  auto switch_0 = start(Role::switch_0);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_role_that_does_not_come_is_named) {
  auto render = start(Role::render, 400ms);
  auto switch_1 = start(Role::switch_1, 5s);
  const std::string error = render.get().error;
  EXPECT_EQ(error, "render node: after 400 ms still without the switch node 0, awaited at " +
                       to_text(render_port.address()));
  EXPECT_NE(switch_1.get().error.find(error), std::string::npos) << "the peer that had come is told";
}

TEST_F(Session, a_port_where_nobody_listens_is_named) {
  const Address closed = Listener(Address{"127.0.0.1", 0}).address();
  addresses[Role::render] = closed;
  const std::string error = start(Role::switch_1, 300ms).get().error;
  EXPECT_NE(error.find("the render node at " + to_text(closed) + " (Connection refused)"), std::string::npos)
      << error;
}

TEST_F(Session, a_peer_that_accepts_and_stays_silent_times_out) {
  // Nobody takes the connections from the ports' queues.
  const std::string error = start(Role::switch_1, 300ms).get().error;
  EXPECT_NE(error.find("still without the render node"), std::string::npos) << error;
}

class KeyedSession : public Session {
 protected:
  KeyedSession() { key.emplace().bytes.fill(9); }
};

TEST_F(KeyedSession, messages_pass_between_all_roles) {
  auto render = start(Role::render), switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1);
  std::array connected = {render.get(), switch_0.get(), switch_1.get()};
  for (const Connected& role : connected) ASSERT_EQ(role.error, "");
  FullSet set{3, VisibleSet(200'000)};
  for (DrawableId id = 0; id < set.visible.size(); ++id) set.visible[id] = id * 7 + id % 5;
  std::thread sender([&] { EXPECT_FALSE(connected[1].mailbox->send(Role::switch_1, Channel::nodes, set)); });
  const auto received = received_by(*connected[2].mailbox);
  sender.join();
  ASSERT_TRUE(received.has_value());
  EXPECT_EQ(std::get<FullSet>(received->message), set);
}

TEST_F(KeyedSession, strangers_and_other_keys_do_not_disturb) {
  auto render = start(Role::render);
  SharedKey right = *key;
  key->bytes.fill(1);
  auto wrong_key = start(Role::switch_0, 400ms);
  auto browser = stranger();
  asio::write(browser, asio::buffer(std::string("GET / HTTP/1.1\r\n\r\n")));
  auto without_key = stranger();
  say(without_key, sample_hello(Role::switch_0));
  std::vector<tcp::socket> crowd;
  for (int i = 0; i < 40; ++i) crowd.push_back(stranger());
  const std::string error = wrong_key.get().error;
  EXPECT_NE(error.find("is the key the same?"), std::string::npos) << error;
  key = right;
  auto switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1);
  expect_all(render, switch_0, switch_1);
}

class Differences : public Session {
 protected:
  /// Switch node 0 differs: it ends with an error that says so and names both; the render node goes on
  /// waiting for the right one and says in the end what it saw.
  void expect_refusal(const Hello& odd, const std::string& what) {
    auto render = start(Role::render, 700ms);
    auto switch_0 = start(odd);
    const std::string at_render = render.get().error, at_odd = switch_0.get().error;
    for (const std::string& error : {at_render, at_odd}) {
      EXPECT_NE(error.find(what + " differs: "), std::string::npos) << error;
      EXPECT_NE(error.find("render node has "), std::string::npos) << error;
      EXPECT_NE(error.find("switch node 0 has "), std::string::npos) << error;
    }
  }
};

TEST_F(Differences, another_protocol_version_is_named_on_both_sides) {
  Hello odd = sample_hello(Role::switch_0);
  odd.version = protocol_version + 1;
  expect_refusal(odd, "protocol version");
}

TEST_F(Differences, another_session_is_named_on_both_sides) {
  Hello odd = sample_hello(Role::switch_0);
  odd.session = 78;
  expect_refusal(odd, "session");
}

TEST_F(Differences, another_pack_is_named_on_both_sides) {
  Hello odd = sample_hello(Role::switch_0);
  odd.pack_hash = 1;
  expect_refusal(odd, "pack");
}

TEST_F(Differences, a_role_that_differs_does_not_keep_the_right_one_away) {
  auto render = start(Role::render);
  Hello old_version = sample_hello(Role::switch_0), other_pack = sample_hello(Role::switch_1);
  old_version.version = protocol_version - 1;
  other_pack.pack_hash = 1;
  EXPECT_NE(start(old_version).get().error, "");
  EXPECT_NE(start(other_pack).get().error, "");
  auto switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_role_that_goes_before_all_have_met_may_come_again) {
  auto render = start(Role::render), switch_1 = start(Role::switch_1);
  {
    // A switch node 0 that meets switch node 1 and is gone.
    asio::io_context context;
    tcp::acceptor acceptor(context, tcp::v4(), ::dup(switch_port.descriptor()));
    tcp::socket caller = acceptor.accept();
    say(caller, sample_hello(Role::switch_0));
    std::this_thread::sleep_for(50ms);
  }
  std::this_thread::sleep_for(150ms);  // until the others have noticed
  auto switch_0 = start(Role::switch_0);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_role_that_came_and_went_was_met_but_one_that_never_came_was_not) {
  auto render = start(Role::render, 200ms);
  const ConnectOutcome outcome =
      connect_session(sample_hello(Role::switch_0), &switch_port, addresses, 600ms);
  EXPECT_EQ(outcome.kind, ConnectOutcome::Kind::peers_missing);
  EXPECT_EQ(outcome.missing, (std::vector{Role::render, Role::switch_1}));
  EXPECT_EQ(outcome.met, std::set{Role::render});
  render.get();
}

TEST_F(Session, waiting_can_be_stopped) {
  std::atomic<bool> stop{false};
  auto waiting = std::async(std::launch::async, [&] {
    return connect_session(sample_hello(Role::render), &render_port, {}, 60s, [&] { return stop.load(); })
        .kind;
  });
  EXPECT_EQ(waiting.wait_for(100ms), std::future_status::timeout);
  stop = true;
  EXPECT_EQ(waiting.wait_for(5s), std::future_status::ready);
  EXPECT_EQ(waiting.get(), ConnectOutcome::Kind::session_over);
}

TEST_F(Session, a_session_that_is_over_ends_the_waiting_of_those_who_had_come) {
  std::atomic<bool> stop{false};
  auto switch_1 = start(Role::switch_1);
  auto render = std::async(std::launch::async, [&] {
    return connect_session(sample_hello(Role::render), &render_port, {}, 60s, [&] { return stop.load(); });
  });
  std::this_thread::sleep_for(300ms);
  stop = true;
  const Connected end = switch_1.get();
  EXPECT_EQ(end.error, "");
  EXPECT_EQ(end.mailbox, nullptr);
}

TEST_F(Session, a_switch_node_that_is_told_to_end_does_not_end_the_session_of_the_others) {
  for (const Role other : {Role::render, Role::switch_0}) {
    SCOPED_TRACE(role_name(other));
    std::atomic<bool> stop{false};
    auto first = start(other);
    auto leaving = std::async(std::launch::async, [&] {
      return connect_session(sample_hello(Role::switch_1), nullptr, addresses, 60s,
                             [&] { return stop.load(); });
    });
    std::this_thread::sleep_for(300ms);  // they have met
    stop = true;
    EXPECT_EQ(leaving.get().kind, ConnectOutcome::Kind::session_over);
    auto second = start(other == Role::render ? Role::switch_0 : Role::render),
         switch_1 = start(Role::switch_1);
    const std::array connected = {first.get(), second.get(), switch_1.get()};
    for (const Connected& role : connected) {
      EXPECT_EQ(role.error, "");
      EXPECT_NE(role.mailbox, nullptr) << "for this one the session is over";
    }
  }
}

TEST_F(Session, another_opengl_is_only_reported) {
  Hello other = sample_hello(Role::switch_1);
  other.device.renderer = "somebody's graphics card";
  auto render = start(Role::render), switch_0 = start(Role::switch_0), switch_1 = start(other);
  const std::array connected = {render.get(), switch_0.get(), switch_1.get()};
  for (const Connected& role : connected) ASSERT_EQ(role.error, "");
  EXPECT_EQ(connected[0].mailbox->peer_hello(Role::switch_1).device.renderer, "somebody's graphics card");
}

TEST_F(Session, strangers_do_not_disturb) {
  auto render = start(Role::render);
  auto browser = stranger();
  asio::write(browser, asio::buffer(std::string("GET / HTTP/1.1\r\n\r\n")));
  auto silent = stranger();
  auto gone = stranger();
  gone.close();
  auto impolite = stranger();
  say(impolite, FullSetRequest{1});
  auto impostor = stranger();
  say(impostor, sample_hello(Role::render));
  std::vector<tcp::socket> crowd;
  for (int i = 0; i < 40; ++i) crowd.push_back(stranger());
  auto switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_second_caller_of_one_role_is_turned_away) {
  auto render = start(Role::render);
  auto first = stranger();
  say(first, sample_hello(Role::switch_0));
  std::array<std::byte, header_bytes> answer{};
  asio::read(first, asio::buffer(answer));
  EXPECT_EQ(decode_header(answer, "render").tag >> 24, Message(Hello{}).index());
  auto second = stranger();
  say(second, sample_hello(Role::switch_0));
  asio::read(second, asio::buffer(answer));
  EXPECT_EQ(decode_header(answer, "render").tag >> 24, Message(Bye{}).index());
  first.close();
  auto switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_caller_that_died_before_anybody_listened_can_come_again) {
  for (int i = 0; i < 3; ++i) {
    auto dead = stranger();
    say(dead, sample_hello(Role::switch_0));
    dead.close();
  }
  auto switch_0 = start(Role::switch_0), switch_1 = start(Role::switch_1), render = start(Role::render);
  expect_all(render, switch_0, switch_1);
}

TEST_F(Session, a_wrong_address_is_named) {
  addresses[Role::switch_0] = render_port.address();
  auto render = start(Role::render, 3s);
  const std::string error = start(Role::switch_1, 3s).get().error;
  EXPECT_NE(error.find(to_text(render_port.address()) + ": is the render node, not the switch node 0"),
            std::string::npos)
      << error;
  render.get();
}

TEST(Connect, a_role_without_its_addresses_or_port_is_refused) {
  EXPECT_THROW(connect_session(sample_hello(Role::render), nullptr, {}, 1s), Error);
  EXPECT_THROW(connect_session(sample_hello(Role::switch_1), nullptr, {}, 1s), Error);
}

TEST(Connect, a_host_that_does_not_exist_is_named) {
  ConnectOutcome outcome =
      connect_session(sample_hello(Role::switch_1), nullptr,
                      {{Role::render, {"no such host.invalid", 1}}, {Role::switch_0, {"127.0.0.1", 1}}}, 1s);
  EXPECT_EQ(outcome.kind, ConnectOutcome::Kind::no_such_host);
  EXPECT_EQ(outcome.place, "no such host.invalid:1");
  EXPECT_THROW(mailbox_or_error(std::move(outcome)), Error);
}

}  // namespace
}  // namespace triptych
