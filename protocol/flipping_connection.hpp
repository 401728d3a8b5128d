// The fault of a byte that changes in transit.
#pragma once

#include "protocol/connection.hpp"

#include <cstdint>
#include <memory>

namespace triptych {

/// Flips one bit in the middle of the body of every `every`-th message that is written to `below`, after its
/// checksum was computed; each write is one message. What is read passes unchanged.
std::shared_ptr<Connection> flipping_connection(std::shared_ptr<Connection> below, uint64_t every = 50);

}  // namespace triptych
