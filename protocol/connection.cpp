#include "protocol/connection.hpp"

#include <fmt/core.h>

namespace triptych {

std::string not_taken(std::chrono::milliseconds timeout) {
  return fmt::format("does not take what is sent to it, for {} ms", timeout.count());
}

}  // namespace triptych
