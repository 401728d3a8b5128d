#include "protocol/listener.hpp"

#include "base/error.hpp"

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <charconv>
#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

namespace triptych {

using asio::ip::tcp;

/// The most callers that wait in the kernel, strangers included.
constexpr int max_waiting = 64;

Address parse_address(const std::string& text) {
  const size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0)
    fail(text, "not an address; give host:port, as in 127.0.0.1:7001");
  std::string host = text.substr(0, colon);
  const bool bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  if (bracketed) host = host.substr(1, host.size() - 2);
  const bool stray = host.find_first_of("[] \t\n/") != std::string::npos;
  if (stray || (!bracketed && host.find(':') != std::string::npos)) {
    fail(text, "not a host; give a name, 127.0.0.1 or [::1] before the port");
  }
  Address address{host, 0};
  const char* begin = text.data() + colon + 1;
  const char* end = text.data() + text.size();
  const auto [stop, problem] = std::from_chars(begin, end, address.port);
  if (problem != std::errc{} || stop != end) fail(text, "not a port; give 0 to 65535 after the colon");
  return address;
}

std::string to_text(const Address& address) {
  const bool brackets = address.host.find(':') != std::string::npos;
  return fmt::format("{}{}{}:{}", brackets ? "[" : "", address.host, brackets ? "]" : "", address.port);
}

bool is_loopback(const Address& address) {
  asio::error_code no_number;
  const auto number = asio::ip::make_address(address.host, no_number);
  return no_number ? address.host == "localhost" : number.is_loopback();
}

Listener::Listener(const Address& address) {
  const std::string place = to_text(address);
  asio::io_context context;
  tcp::resolver resolver(context);
  asio::error_code error;
  const auto found =
      resolver.resolve(address.host, std::to_string(address.port), tcp::resolver::passive, error);
  if (error) fail(place, "cannot listen: {}", error.message());
  const tcp::endpoint endpoint = found.begin()->endpoint();
  tcp::acceptor acceptor(context);
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(max_waiting, error);
  if (error) fail(place, "cannot listen: {}", error.message());
  descriptor_ = acceptor.release(error);
  if (error) fail(place, "cannot listen: {}", error.message());
  set_inherited(false);
  read_address();
}

Listener::Listener(int descriptor) : descriptor_(descriptor) {
  int listening = 0;
  socklen_t size = sizeof(listening);
  if (::getsockopt(descriptor, SOL_SOCKET, SO_ACCEPTCONN, &listening, &size) != 0 || listening == 0) {
    descriptor_ = -1;
    fail(fmt::format("descriptor {}", descriptor), "not a listening socket");
  }
  set_inherited(false);
  read_address();
}

void Listener::read_address() {
  tcp::endpoint endpoint;
  auto size = static_cast<socklen_t>(endpoint.capacity());
  if (::getsockname(descriptor_, endpoint.data(), &size) != 0) {
    fail(fmt::format("descriptor {}", descriptor_), "has no address");
  }
  endpoint.resize(size);
  address_ = {endpoint.address().to_string(), endpoint.port()};
  ipv6_ = endpoint.address().is_v6();
}

Listener::~Listener() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Listener::Listener(Listener&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      address_(std::move(other.address_)),
      ipv6_(other.ipv6_) {}

void Listener::set_inherited(bool inherited) { ::fcntl(descriptor_, F_SETFD, inherited ? 0 : FD_CLOEXEC); }

}  // namespace triptych
