// The kernel's figures of a TCP connection (TCP_INFO), beside our own counts.
#pragma once

#include <cstdint>

namespace triptych {

/// All zero where the kernel has none.
struct TcpFigures {
  uint64_t bytes_sent = 0;       ///< payload, retransmitted bytes included
  uint64_t bytes_received = 0;   ///< payload that the other side had acknowledged
  uint64_t retransmissions = 0;  ///< segments
  double round_trip_ms = 0;      ///< smoothed (RFC 6298)
  double min_round_trip_ms = 0;
};

TcpFigures tcp_figures(int socket);

}  // namespace triptych
