#include "protocol/listener.hpp"

#include "base/error.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

namespace triptych {
namespace {

TEST(Address, hosts_and_ports_are_read) {
  EXPECT_EQ(parse_address("127.0.0.1:7001"), (Address{"127.0.0.1", 7001}));
  EXPECT_EQ(parse_address("render.local:0"), (Address{"render.local", 0}));
  EXPECT_EQ(parse_address("[::1]:65535"), (Address{"::1", 65535}));
  EXPECT_EQ(to_text({"::1", 7}), "[::1]:7");
  EXPECT_EQ(to_text({"127.0.0.1", 7}), "127.0.0.1:7");
}

TEST(Address, nonsense_is_refused_with_its_text) {
  for (const std::string text :
       {"", ":", "7001", ":7001", "host", "host:", "host:x", "host:65536", "host:-1", "host: 1", "host:1x",
        "::1:7001", "[::1:7001", "[]:1", "a b:1", "host/x:1"}) {
    try {
      parse_address(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(text + ": not a", 0), 0u) << error.what();
    }
  }
}

TEST(Listener, port_0_is_any_free_port) {
  const Listener listener(Address{"127.0.0.1", 0});
  EXPECT_NE(listener.port(), 0);
  EXPECT_EQ(listener.address().host, "127.0.0.1");
}

TEST(Listener, a_port_in_use_is_refused_with_its_address) {
  const Listener first(Address{"127.0.0.1", 0});
  try {
    const Listener second(first.address());
    FAIL() << "bound twice";
  } catch (const Error& error) {
    EXPECT_EQ(error.what(), to_text(first.address()) + ": cannot listen: Address already in use");
  }
}

TEST(Listener, a_host_of_another_machine_is_refused) {
  EXPECT_THROW(Listener(Address{"192.0.2.1", 0}), Error);
}

TEST(Listener, a_listening_descriptor_can_be_inherited) {
  Listener parent(Address{"127.0.0.1", 0});
  const Listener child(::dup(parent.descriptor()));
  EXPECT_EQ(child.address(), parent.address());
}

TEST(Listener, a_descriptor_that_does_not_listen_is_refused) {
  EXPECT_THROW(Listener(STDIN_FILENO), Error);
  EXPECT_THROW(Listener(12345), Error);
}

}  // namespace
}  // namespace triptych
