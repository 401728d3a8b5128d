// Where a role listens, and addresses of roles.
#pragma once

#include <cstdint>
#include <string>

namespace triptych {

/// A host (name, IPv4 or IPv6 number) and a port.
struct Address {
  std::string host;
  uint16_t port = 0;
  bool operator==(const Address&) const = default;
};

/// "127.0.0.1:7001", "render.local:7001", "[::1]:7001". Error (place: the text) for anything else.
Address parse_address(const std::string& text);
std::string to_text(const Address& address);
/// 127.0.0.0/8, ::1 or localhost: only reachable from this machine.
bool is_loopback(const Address& address);

/// A port that is bound from its construction on; connections wait there until connect_session takes them.
class Listener {
 public:
  /// Port 0 binds any free one. Error (place: the address) where it cannot listen.
  explicit Listener(const Address& address);
  /// Takes over a listening socket that was inherited, so that a parent can bind for its children without a
  /// race. Error if the descriptor is not one.
  explicit Listener(int descriptor);
  ~Listener();
  Listener(Listener&& other) noexcept;
  Listener& operator=(Listener&&) = delete;

  uint16_t port() const { return address_.port; }
  const Address& address() const { return address_; }
  int descriptor() const { return descriptor_; }
  bool is_ipv6() const { return ipv6_; }
  /// Whether child processes inherit it; after construction they do not.
  void set_inherited(bool inherited);

 private:
  void read_address();
  int descriptor_ = -1;
  Address address_;
  bool ipv6_ = false;
};

}  // namespace triptych
