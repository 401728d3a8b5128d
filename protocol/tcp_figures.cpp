#include "protocol/tcp_figures.hpp"

#include <linux/tcp.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace triptych {

TcpFigures tcp_figures(int socket) {
  tcp_info info{};
  socklen_t size = sizeof(info);
  if (::getsockopt(socket, IPPROTO_TCP, TCP_INFO, &info, &size) != 0) return {};
  return {.bytes_sent = info.tcpi_bytes_sent,
          .bytes_received = info.tcpi_bytes_received,
          .retransmissions = info.tcpi_total_retrans,
          .round_trip_ms = info.tcpi_rtt / 1000.0,
          .min_round_trip_ms = info.tcpi_min_rtt / 1000.0};
}

}  // namespace triptych
