// Connections between machines.
#pragma once

#include "protocol/connection.hpp"

#include <asio/ip/tcp.hpp>
#include <memory>

namespace triptych {

/// A connected socket. It becomes non-blocking, without Nagle's delay, and the kernel is asked to notice
/// within about ten seconds that the other machine is gone. The place is the other end's address.
std::shared_ptr<Connection> tcp_connection(asio::ip::tcp::socket socket);

}  // namespace triptych
